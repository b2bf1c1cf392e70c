// The surfaces of a building in the making: walls and roof first, then its floor.
#pragma once

#include <cstddef>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "tools/city/city_model.h"
#include "tools/map_buildings/building_tags.h"
#include "tools/map_buildings/roofs.h"

namespace nightcity::map_buildings {

using Ring2 = std::vector<glm::dvec2>;
using HeightOver = std::function<double(const glm::dvec2&)>;

inline double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// Collects surfaces. Those who add walls over a ring with more vertices than the outline pass that
/// ring to `set_floor`, so that the floor has the same.
class Shell {
 public:
  Shell(const Outline& outline, const BuildingSizes& sizes)
      : outline_(outline), sizes_(sizes), floor_(outline.outer) {}

  const Ring2& outer() const { return outline_.outer; }
  const BuildingSizes& sizes() const { return sizes_; }
  double rise_m() const { return sizes_.top_m - sizes_.eaves_m; }

  /// Adds a roof in one plane with its walls, holes included.
  void add_plane(const HeightOver& height);
  /// Adds walls from the foot up to a height.
  void add_walls(const Ring2& ring, const HeightOver& height);
  /// Adds a wall with corners of its own, anticlockwise from outside.
  void add_wall(city::Ring corners);
  /// Adds a face of the roof, anticlockwise from outside.
  void add_roof(city::Ring corners);
  void set_floor(Ring2 ring) { floor_ = std::move(ring); }

  /// Adds the floor, and gives all away.
  std::vector<city::Polygon> take();

 private:
  const Outline& outline_;
  const BuildingSizes& sizes_;
  Ring2 floor_;
  std::vector<city::Polygon> polygons_;
};

}  // namespace nightcity::map_buildings
