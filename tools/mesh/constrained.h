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
  std::vector<double> area_outside;  // of each outline: that of its inside beyond the exterior's
};

/// `outlines[i]` holds indices into `points`, not closed: first the exterior, then holes, which may
/// run either way, touch and cross. A place is in an outline that goes round it an odd number of
/// times. What is in the exterior and in no hole is triangulated (ISO 19107, 6.6.11: a surface lies
/// within its exterior, less its interiors). Throws Error where outlines cross more than
/// `max_crossings_a_point` times as often as they have points (n edges may cross n^2 / 2 times,
/// real ones cross a few times), and where more than 100 lie within each other.
FlatTriangulation triangulate_flat(std::span<const glm::dvec2> points,
                                   std::span<const std::vector<std::uint32_t>> outlines,
                                   std::size_t max_crossings_a_point = 16);

}  // namespace nightcity::mesh
