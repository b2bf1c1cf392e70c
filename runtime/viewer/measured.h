// Draws a distance that the user measures.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "runtime/scene/camera.h"

namespace nightcity::viewer {

/// Returns "12.34 m (10.00 m level, 7.23 m up)".
std::string describe_distance(const glm::vec3& from, const glm::vec3& to);

/// Draws the points, the line between them and its length.
void draw_measured(const glm::vec3& from, const glm::vec3& to, const scene::CameraPose& pose,
                   const glm::vec2& window);

}  // namespace nightcity::viewer
