#include "tools/barriers/barrier_ends.h"

#include <algorithm>

namespace nightcity::barriers {
namespace {

constexpr double cotangent = 3.3;  // of 17 degrees
constexpr double look_m = 0.05;    // what lies nearer ahead of an end is met there
constexpr double exact_m = 1e-3;

}  // namespace

BarrierEnd find_end(const glm::dvec2& end, const glm::dvec2& outward, double width_m,
                    double max_back_m, const std::function<bool(const glm::dvec2&)>& blocks) {
  const glm::dvec2 left(-outward.y, outward.x);
  const double reach_m = cotangent * width_m / 2;
  const bool meets = blocks(end + outward * look_m);
  const auto find_side = [&](double aside_m) {
    const auto is_blocked = [&](double m) { return blocks(end + left * aside_m + outward * m); };
    const bool starts_blocked = is_blocked(0);
    if (!starts_blocked && !meets) return 0.0;
    const double sign = starts_blocked ? -1 : 1;
    double free_m = 0, blocked_m = 0;  // both sides of the outline, once it is found
    double m = 0;
    while (m < reach_m && is_blocked(sign * m) == starts_blocked) m += look_m;
    if (is_blocked(sign * m) == starts_blocked) return 0.0;  // it runs along, or passes by
    (starts_blocked ? free_m : blocked_m) = m;
    (starts_blocked ? blocked_m : free_m) = m - look_m;
    while (std::abs(free_m - blocked_m) > exact_m) {
      const double middle = (free_m + blocked_m) / 2;
      (is_blocked(sign * middle) ? blocked_m : free_m) = middle;
    }
    return std::max(sign * free_m, -max_back_m);
  };
  return {find_side(width_m / 2), find_side(-width_m / 2)};
}

}  // namespace nightcity::barriers
