// Some coordinates from the beginning of a file, for its frame.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "tools/city/city_reader.h"
#include "tools/cityjson/json.h"

namespace nightcity::cityjson {

constexpr std::size_t enough_points = 4096;

/// Gathers the vertex numbers of rings first, then the vertices, which may come in pieces.
class Sample {
 public:
  /// Adds the rings of a city object, and the places of its templates.
  void add_object(const dom::element& object);
  bool is_full() const { return points_ >= enough_points; }
  /// Takes those of these vertices that the rings need. `first`: the number of the first.
  void take_vertices(std::span<const glm::dvec3> vertices, std::size_t first);
  /// Returns whether all that are needed have been taken.
  bool is_complete() const { return missing_ == 0; }
  /// Adds the rings, closed, without those of which vertices are missing.
  void move_to(city::CityHead& head);

 private:
  std::vector<std::vector<std::size_t>> rings_;
  std::vector<std::vector<glm::dvec3>> coordinates_;  // beside rings_
  std::size_t points_ = 0, missing_ = 0;
};

}  // namespace nightcity::cityjson
