// Ways of a map as lines of the city's frame.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "tools/ground_cover/box_index.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"

namespace nightcity::ground_cover {

/// Returns the points of a line (longitude, latitude) in E, N, m, without those that are not
/// finite; empty where all of it lies outside `bounds`.
std::vector<glm::dvec2> find_line(const std::vector<glm::dvec2>& lon_lat,
                                  const place::LonLatToFrame& to_frame, const Box& bounds);

}  // namespace nightcity::ground_cover
