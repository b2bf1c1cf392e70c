// Where lights lie on a picture: drawn over the picture, so that one sees what shines and what is dark for
// want of a lamp.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <vector>

#include "formats/light.h"
#include "shaders/interface.h"

namespace nightcity {

/// Position in the window, (0, 0) its upper left corner and (1, 1) its lower right; nothing behind the eye.
std::optional<glm::vec2> project(const gpu::Camera& camera, const glm::vec3& position);

struct Marker {
  glm::vec2 at;       // as project() has it, within 0 .. 1
  float distance;     // from the eye, m
  std::size_t light;  // index
};

/// Lights within the window, the nearest `most` of them, nearest last so that it is drawn on top.
std::vector<Marker> find_markers(const gpu::Camera& camera, std::span<const Light> lights,
                                 std::size_t most);

}  // namespace nightcity
