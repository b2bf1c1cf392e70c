// The outline of a ground that comes triangle by triangle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <unordered_map>
#include <vector>

#include "tools/mesh/triangle_mesh.h"

namespace nightcity::terrain {

/// Keeps the edges, seen from above, that only one triangle has: those between neighbours cancel as
/// soon as both have come. Vertices are the same where they round to the same millimetre of the
/// plan.
class Outline {
 public:
  /// Adds triangles (E, N, H, m) of any winding. Those that stand upright have no plan and are left
  /// out, as are those that are not finite or lie over 1e12 m away.
  void add(const mesh::TriangleMesh& mesh);
  /// Adds the edges of another outline.
  void add(const Outline& other);

  /// Returns the rings that go round the ground on the outside, counter-clockwise: one for each
  /// part that is connected. Rings of holes are left out, and so are those of less than a square
  /// metre: cracks between surfaces whose vertices differ. The order does not depend on that of the
  /// triangles.
  std::vector<std::vector<glm::dvec3>> find_rings() const;

 private:
  using Place = std::array<std::int64_t, 2>;  // mm
  struct Edge {
    Place from, to;  // from < to
    bool operator==(const Edge&) const = default;
  };
  struct EdgeHash {
    std::size_t operator()(const Edge& edge) const;
  };
  struct Sides {
    std::int64_t surplus = 0;  // triangles on its left less those on its right
    glm::dvec3 from{0}, to{0};
  };

  void add_edge(const Edge& edge, const Sides& sides);

  std::unordered_map<Edge, Sides, EdgeHash> edges_;
};

}  // namespace nightcity::terrain
