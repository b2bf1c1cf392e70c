// Lines of the plan on the ground.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "tools/place/site.h"

namespace nightcity::barriers {

/// Returns points of the plan with the heights of the ground, and between them those at which the
/// ground bends. One that lies beyond the ground or on a kerb has the height of its neighbour; none
/// where no point has a height.
std::vector<glm::dvec3> put_on_ground(const std::vector<glm::dvec2>& places,
                                      const place::HeightAt& height_at);

}  // namespace nightcity::barriers
