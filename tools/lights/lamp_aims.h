// Directions in which the luminaires of a post shine.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "tools/lights/lamp_tags.h"
#include "tools/lights/road_index.h"
#include "tools/place/site.h"

namespace nightcity::lights {

/// Returns one direction for each luminaire: as tagged, otherwise towards the road. Several
/// luminaires of one direction spread evenly round the post; of several directions each has the
/// next luminaire in turn. `lon_lat` and `foot`: of the post, in degrees and in the frame.
std::vector<glm::dvec2> find_aims(const glm::dvec2& lon_lat, const LampTags& tags,
                                  const glm::dvec3& foot,
                                  const std::optional<RoadIndex::Nearest>& road,
                                  const place::LonLatToFrame& to_frame);

}  // namespace nightcity::lights
