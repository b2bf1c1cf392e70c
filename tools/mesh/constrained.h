// Triangles inside a set of closed outlines in the plane, by CGAL's constrained Delaunay
// triangulation.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

namespace nightcity::mesh {

struct FlatTriangulation {
  /// Into `points`; counter-clockwise.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// The input's points first, in order; behind them those made where outlines cross.
  std::vector<glm::dvec2> points;
  bool crossing = false;  // outlines cross each other or themselves
};

/// `outlines[i]` holds indices into `points`, not closed. A place is inside when it is enclosed by
/// an odd number of outlines: right for holes, also those touching the shell, whatever their
/// direction. Throws Error where outlines cross more than 16 times as often as they have points.
FlatTriangulation triangulate_flat(std::span<const glm::dvec2> points,
                                   std::span<const std::vector<std::uint32_t>> outlines);

}  // namespace nightcity::mesh
