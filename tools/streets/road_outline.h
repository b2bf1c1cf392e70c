// The outline of all road surfaces together: neighbours are joined, thin gaps closed and
// small islands filled.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "tools/city/city_reader.h"
#include "tools/streets/road_surfaces.h"

namespace nightcity::streets {

/// Narrower gaps between surfaces are errors of the model.
constexpr double gap_m = 0.3;
/// Traffic drives round smaller islands within one junction.
constexpr double island_m2 = 60;

using OutlineEdge = std::pair<glm::dvec2, glm::dvec2>;

/// Returns the edges of the union of the surfaces, each once, in no particular order. Throws Error
/// where their rings cross more than `max_crossings` times as often as they have points.
std::vector<OutlineEdge> road_outline(std::span<const RoadSurface> surfaces,
                                      int max_crossings = city::PolygonLimits{}.max_crossings);

}  // namespace nightcity::streets
