// A bounding volume hierarchy of static triangles as a scene file holds it (SPEC.md, 2.6): which
// triangles lie in which leaf, below which nodes. Boxes are measured by whoever reads it.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace nightcity {

/// Nothing of it has been checked but that the arrays lie in the file.
struct StoredHierarchy {
  bool casts_shadow = true;
  std::vector<std::uint32_t> nodes;  // of glTF, whose triangles these are, in their order
  std::uint32_t triangles = 0;
  glm::vec3 lower{0}, upper{0};  // their box in model space, m
  glm::vec2 along{1, 0};         // x and z of the direction that boxes of nodes lie along
  double area_m2 = 0;            // half the surfaces of all children's boxes, summed
  // Little-endian numbers of 16 and 32 bits, as formats/hierarchy/topology.h reads them, and cuts as
  // formats/hierarchy/cuts.h does.
  std::span<const std::byte> topology, order, cuts;

  /// Returns how many cuts there are, of 8 bytes each.
  std::size_t count_cuts() const { return cuts.size() / 8; }
};

/// Returns whether these are x and z of a unit vector.
inline bool is_direction(const glm::vec2& along) {
  return std::abs(along.x * along.x + along.y * along.y - 1) < 1e-5f;
}

}  // namespace nightcity
