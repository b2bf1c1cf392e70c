#include "tools/terrain/ground_points.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "formats/finite.h"

namespace nightcity::terrain {

void GroundPoints::add(const glm::dvec3& p) {
  if (!finite(p)) return;
  points_.push_back(p);
  if (points_.size() > max_points_) thin();
}

std::vector<glm::dvec3> GroundPoints::take() {
  return std::exchange(points_, {});
}

void GroundPoints::thin() {
  constexpr double first_spacing_m = 2;
  // Thins to below half, so that it rarely has to happen again.
  for (bool again = false; again || points_.size() > max_points_;
       again = points_.size() > max_points_ / 2) {
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

}  // namespace nightcity::terrain
