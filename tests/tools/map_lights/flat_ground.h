// A level ground for tests, on which degrees stand for metres.
#pragma once

#include <cmath>

#include "tools/map_lights/ground.h"

namespace nightcity::test {

/// The ground lies at 5 m within 1000 m of the origin; there are no buildings.
inline map_lights::Ground make_flat_ground() {
  map_lights::Ground ground;
  ground.to_frame = [](const glm::dvec2& p) { return p; };
  ground.height_at = [](const glm::dvec2& p) {
    return std::max(std::abs(p.x), std::abs(p.y)) <= 1000 ? std::optional(5.0) : std::nullopt;
  };
  return ground;
}

}  // namespace nightcity::test
