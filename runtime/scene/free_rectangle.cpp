#include "runtime/scene/free_rectangle.h"

#include <algorithm>
#include <glm/common.hpp>
#include <vector>

namespace nightcity::scene {
namespace {

using Polygon = std::vector<glm::dvec2>;

// Returns the part of a convex polygon whose coordinate on an axis is at least `bound`, or at most
// (Sutherland and Hodgman, Reentrant polygon clipping, CACM 17, 1974).
Polygon clip(const Polygon& polygon, int axis, double bound, bool at_least) {
  Polygon kept;
  const auto depth = [&](const glm::dvec2& p) {
    return at_least ? p[axis] - bound : bound - p[axis];
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = depth(a), at_b = depth(b);
    if (at_a >= 0) kept.push_back(a);
    if ((at_a > 0 && at_b < 0) || (at_a < 0 && at_b > 0))
      kept.push_back(glm::mix(a, b, at_a / (at_a - at_b)));
  }
  return kept;
}

}  // namespace

void FreeRectangle::leave_out(const std::array<glm::vec3, 3>& triangle) {
  if (empty()) return;
  Polygon inside;
  for (const glm::vec3& p : triangle) inside.emplace_back(p.x, p.z);
  for (int axis = 0; axis < 2; ++axis) {
    inside = clip(inside, axis, double(lower_[axis]), true);
    inside = clip(inside, axis, double(upper_[axis]), false);
  }
  if (inside.empty()) return;
  glm::vec2 low = upper_, high = lower_;
  for (const glm::dvec2& p : inside) {
    low = glm::min(low, glm::vec2(p));
    high = glm::max(high, glm::vec2(p));
  }
  float largest = 0;
  FreeRectangle best(upper_, lower_);
  const auto consider = [&](const glm::vec2& lower, const glm::vec2& upper) {
    const glm::vec2 left = upper - lower;
    if (!(left.x > 0 && left.y > 0 && left.x * left.y > largest)) return;
    largest = left.x * left.y;
    best = {lower, upper};
  };
  consider({high.x, lower_.y}, upper_);
  consider({lower_.x, high.y}, upper_);
  consider(lower_, {low.x, upper_.y});
  consider(lower_, {upper_.x, low.y});
  *this = best;
}

}  // namespace nightcity::scene
