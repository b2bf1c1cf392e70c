// Cuts the plane into regions that do not overlap, by outlines that may: in each of several layers
// the first area that holds a place owns it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "tools/mesh/owner_finder.h"

namespace nightcity::mesh {

struct PlanePartition {
  struct Triangle {
    std::array<std::uint32_t, 3> vertex;  // into `points`, counter-clockwise
    std::uint32_t region;
  };
  std::vector<glm::dvec2> points;
  std::vector<Triangle> triangles;  // of all regions that some area holds
  /// The label of each region's owner in each layer, no_label where it has none.
  std::vector<std::vector<std::uint32_t>> owners;
};

/// Returns the regions as one constrained Delaunay triangulation: neighbours share their vertices,
/// and edges lie only where an owner changes in some layer. Where outlines cross, the vertex is
/// rounded to doubles, which may move an outline by as much and nothing else: no two triangles
/// overlap. Vertices that are not finite are left out. Throws Error where outlines cross more than
/// `max_crossings_a_point` times as often as they have points.
PlanePartition partition(std::span<const PlaneLayer> layers,
                         std::size_t max_crossings_a_point = 16);

}  // namespace nightcity::mesh
