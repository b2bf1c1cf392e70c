// Markers of lights, drawn over a picture. They tell a lamp that is dark
// from a place without a lamp.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "formats/light.h"
#include "shaders/interface.h"

namespace nightcity::scene {

/// Returns the position in the picture, from (0, 0) in the upper left corner to (1, 1) in the lower
/// right; nothing for a place behind the camera.
std::optional<glm::vec2> project(const gpu::Camera& camera, const glm::vec3& position);

struct Marker {
  glm::vec2 at;       // as project() returns it, within 0 .. 1
  float distance;     // from the camera, m
  std::size_t light;  // index
};

/// Returns the nearest `most` of the lights within the picture, the nearest last, so that it is
/// drawn on top.
std::vector<Marker> find_markers(const gpu::Camera& camera, std::span<const Light> lights,
                                 std::size_t most);

}  // namespace nightcity::scene
