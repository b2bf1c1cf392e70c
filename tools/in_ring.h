// Tests whether a place lies inside a ring.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <vector>

namespace nightcity {

/// Returns whether `p` lies inside `ring` (first point not repeated), by the even-odd rule. A place
/// on an edge may be either.
inline bool in_ring(const std::vector<glm::dvec2>& ring, const glm::dvec2& p) {
  bool odd = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const glm::dvec2 &a = ring[k], &b = ring[(k + 1) % ring.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
      odd = !odd;
  }
  return odd;
}

}  // namespace nightcity
