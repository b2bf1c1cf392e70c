// The part of a scene that is worth seeing at night.
#pragma once

#include <glm/vec3.hpp>

#include "runtime/scene/render_scene.h"

namespace nightcity::scene {

struct LitPart {
  glm::vec3 centre;
  float radius_m;  // horizontal
};

/// Returns the lit part of the city: around the median light, out to the distance that contains
/// nine tenths of the lights, within 20 to 600 m. With few lights, the whole scene.
LitPart find_lit_part(const RenderScene& scene);

}  // namespace nightcity::scene
