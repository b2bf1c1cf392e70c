// The edges of an object's polygons, with who uses them: what tells a closed shell from an open one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "tools/city/city_model.h"

namespace nightcity {

/// A polygon's way along an edge. Vertices are numbered by place: within a millimetre they are one.
struct EdgeUse {
  std::uint32_t low, high;  // vertex numbers, low < high
  std::uint32_t polygon;
  bool forward;  // from low to high

  bool same_edge(const EdgeUse& other) const { return low == other.low && high == other.high; }
};

class EdgeTable {
 public:
  /// Coordinates in metres, finite. Walls between two parts of one building, which meet others at every one
  /// of their edges, are left out: without them, what is left is the shell round both.
  explicit EdgeTable(const CityObject& object);

  /// All uses, those of one edge side by side.
  std::span<const EdgeUse> uses() const { return uses_; }
  /// Uses of the edge that uses()[i] belongs to.
  std::span<const EdgeUse> edge_of(std::size_t i) const {
    return {&uses_[begin_[i]], end_[i] - begin_[i]};
  }
  /// Indices into uses() of one polygon's, in no order that means anything.
  std::span<const std::uint32_t> of_polygon(std::uint32_t polygon) const {
    return {of_polygon_.data() + first_[polygon], first_[polygon + 1] - first_[polygon]};
  }
  std::size_t vertex_count() const { return places_.size(); }
  /// A place (the first of those that are one).
  const glm::dvec3& place(std::uint32_t vertex) const { return places_[vertex]; }

 private:
  void number(const CityObject& object);
  void leave_out_inner_walls(std::size_t polygons);
  void index(std::size_t polygons);

  std::vector<EdgeUse> uses_;
  std::vector<std::uint32_t> begin_, end_, of_polygon_, first_;
  std::vector<glm::dvec3> places_;
};

struct MeshReport;

/// The work behind close_gaps and orient_outward (triangle_mesh.h), over a table made by the caller. True:
/// the object has changed, and the table no longer fits.
bool close_gaps_along(CityObject& object, const EdgeTable& edges, MeshReport& report);
void orient_along(CityObject& object, const EdgeTable& edges, MeshReport& report);

}  // namespace nightcity
