// Simple shapes of things that stand in a city.
#pragma once

#include <cstdint>

#include "formats/scene.h"

namespace nightcity::bake {

/// Returns an upright prism of unit height about the y axis, open at the foot. `radius` in m.
ScenePrimitive make_prism(float radius, std::uint32_t sides, std::uint32_t material);

/// Returns a box of unit size, its underside in the middle of y = 0.
ScenePrimitive make_box(std::uint32_t material);

}  // namespace nightcity::bake
