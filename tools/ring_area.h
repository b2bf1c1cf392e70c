// Areas of rings.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

namespace nightcity {

/// Returns the area of a ring (first point not repeated), positive if it runs anticlockwise. Its
/// coordinates are taken from its first point, so that it keeps its digits far from the origin.
inline double signed_area(const std::vector<glm::dvec2>& ring) {
  double sum = 0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const glm::dvec2 a = ring[k] - ring[0], b = ring[(k + 1) % ring.size()] - ring[0];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum / 2;
}

}  // namespace nightcity
