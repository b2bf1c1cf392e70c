#include "tools/terrain/ground_points.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace nightcity {

void GroundPoints::add(const glm::dvec3& p) {
  if (!std::isfinite(p.x + p.y + p.z)) return;
  points_.push_back(p);
  if (points_.size() > most_) thin();
}

std::vector<glm::dvec3> GroundPoints::take() {
  return std::exchange(points_, {});
}

void GroundPoints::thin() {
  constexpr double first_spacing_m = 2;
  // Below half, so that thinning is rare whatever comes.
  for (bool again = false; again || points_.size() > most_; again = points_.size() > most_ / 2) {
    if (again || spacing_ == 0) spacing_ = spacing_ == 0 ? first_spacing_m : 2 * spacing_;
    const auto cell = [&](double v) { return std::floor(v / spacing_); };
    const auto key = [&](const glm::dvec3& p) {
      return std::make_tuple(cell(p.x), cell(p.y), p.z, p.x, p.y);
    };
    std::sort(points_.begin(), points_.end(),
              [&](const glm::dvec3& a, const glm::dvec3& b) { return key(a) < key(b); });
    points_.erase(std::unique(points_.begin(), points_.end(),
                              [&](const glm::dvec3& a, const glm::dvec3& b) {
                                return cell(a.x) == cell(b.x) && cell(a.y) == cell(b.y);
                              }),
                  points_.end());
  }
}

}  // namespace nightcity
