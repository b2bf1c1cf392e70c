// Squares that the plan of a city is cut into.
#pragma once

#include <compare>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace nightcity::bake {

/// Spans [column, column + 1) * size in easting, [row, row + 1) * size in northing.
struct Tile {
  std::int32_t column, row;
  auto operator<=>(const Tile&) const = default;
};

/// Decides which tile each triangle of one object belongs to. All go to the tile of the object's
/// centre unless the object is larger than a tile (terrain, long roads): then each goes to that of
/// its own centre. First add every triangle, then ask. Coordinates are E, N, H in metres.
class ObjectTiles {
 public:
  explicit ObjectTiles(double size_m) : size_m_(size_m) {}

  void add(const glm::dvec3 (&corners)[3]);
  Tile find_tile(const glm::dvec3 (&corners)[3]) const;

 private:
  double size_m_;
  glm::dvec2 min_{std::numeric_limits<double>::infinity()},
      max_{-std::numeric_limits<double>::infinity()};
};

}  // namespace nightcity::bake
