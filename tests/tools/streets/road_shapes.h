// Road surfaces whose centrelines are known.
#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tools/streets/road_surfaces.h"

namespace nightcity::test {

/// Returns a rectangle round the straight line from a to b.
inline streets::RoadSurface strip(const glm::dvec2& a, const glm::dvec2& b, double width) {
  const glm::dvec2 along = glm::normalize(b - a),
                   side = glm::dvec2(-along.y, along.x) * (width / 2);
  return {{a - side, b - side, b + side, a + side}, {}, nullptr, true};
}

inline streets::PlanRing circle(const glm::dvec2& middle, double radius, int corners) {
  streets::PlanRing ring;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    ring.push_back(middle + glm::dvec2(std::cos(angle), std::sin(angle)) * radius);
  }
  return ring;
}

}  // namespace nightcity::test
