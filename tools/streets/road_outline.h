// The outline of all road surfaces together: neighbours joined, hair gaps closed, small islands filled.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "tools/streets/road_surfaces.h"

namespace nightcity::streets {

/// Gaps between surfaces narrower than this are faults of drawing.
constexpr double gap_m = 0.3;
/// Islands smaller than this are driven round within one junction.
constexpr double island_m2 = 60;

using OutlineEdge = std::pair<glm::dvec2, glm::dvec2>;

/// Of the union of the surfaces; each edge once, in no order.
std::vector<OutlineEdge> road_outline(std::span<const RoadSurface> surfaces);

}  // namespace nightcity::streets
