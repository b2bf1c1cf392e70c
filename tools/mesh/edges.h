// The edges of an object's polygons with the polygons that use them: they show whether a shell is
// closed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "tools/city/city_model.h"

namespace nightcity::mesh {

/// The use of an edge by a polygon. Vertices are numbered by place, from west to east: within
/// EdgeTable::one_place_m they are one.
struct EdgeUse {
  std::uint32_t low, high;  // vertex numbers, low < high
  std::uint32_t polygon;
  bool forward;  // from low to high

  bool same_edge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

class EdgeTable {
 public:
  static constexpr double one_place_m = 0.001;

  /// Coordinates in metres, finite. Walls between two parts of one building, which meet others at
  /// every one of their edges, are left out, so that the rest is the shell around both.
  explicit EdgeTable(const city::CityObject& object);

  /// Returns all uses, those of one edge side by side.
  std::span<const EdgeUse> uses() const { return uses_; }
  /// Returns the uses of the edge that uses()[i] belongs to.
  std::span<const EdgeUse> edge_of(std::size_t i) const {
    return {&uses_[begin_[i]], end_[i] - begin_[i]};
  }
  /// Returns indices into uses() of one polygon's uses, in no particular order.
  std::span<const std::uint32_t> of_polygon(std::uint32_t polygon) const {
    return {of_polygon_.data() + first_[polygon], first_[polygon + 1] - first_[polygon]};
  }
  std::size_t vertex_count() const { return places_.size(); }
  /// Returns the place of a vertex (the first of those that are one).
  const glm::dvec3& place(std::uint32_t vertex) const { return places_[vertex]; }

 private:
  void number_vertices(const city::CityObject& object);
  void leave_out_inner_walls(std::size_t polygons);
  void index_uses(std::size_t polygons);

  std::vector<EdgeUse> uses_;
  std::vector<std::uint32_t> begin_, end_, of_polygon_, first_;
  std::vector<glm::dvec3> places_;
};

}  // namespace nightcity::mesh
