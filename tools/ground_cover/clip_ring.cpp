#include "tools/ground_cover/clip_ring.h"

#include <utility>

namespace nightcity::ground_cover {
namespace {

// Returns the part of a ring on one side of a line: sign * coordinate[axis] <= sign * limit.
std::vector<glm::dvec2> clip_side(const std::vector<glm::dvec2>& ring, int axis, double sign,
                                  double limit) {
  std::vector<glm::dvec2> out;
  const auto is_inside = [&](const glm::dvec2& p) { return sign * p[axis] <= sign * limit; };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const glm::dvec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
    if (is_inside(a)) out.push_back(a);
    if (is_inside(a) == is_inside(b)) continue;
    // From the same end, whichever way the ring runs, so that neighbours meet.
    const auto [from, to] = is_inside(a) ? std::pair(a, b) : std::pair(b, a);
    glm::dvec2 crossing = from + (to - from) * ((limit - from[axis]) / (to[axis] - from[axis]));
    crossing[axis] = limit;
    out.push_back(crossing);
  }
  return out;
}

}  // namespace

std::vector<glm::dvec2> clip_ring(const std::vector<glm::dvec2>& ring, const glm::dvec2& low,
                                  const glm::dvec2& high) {
  std::vector<glm::dvec2> out = ring;
  for (int axis = 0; axis < 2; ++axis) {
    out = clip_side(out, axis, 1, high[axis]);
    out = clip_side(out, axis, -1, low[axis]);
  }
  return out;
}

}  // namespace nightcity::ground_cover
