#include "runtime/viewer/metering.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "runtime/measure/exposure.h"

namespace nightcity::viewer {
namespace {

constexpr float seen_ev = 0.05f;          // a difference that is not seen
constexpr double time_constant_s = 0.43;  // 1 - exp(-1 / 0.43) = 0.9

}  // namespace

Metered meter_picture(const measure::Image& picture) {
  return {std::clamp(measure::auto_exposure_ev100(picture), min_ev100, max_ev100),
          measure::mean_light(picture)};
}

glm::vec3 follow_light(const glm::vec3& before, const glm::vec3& metered) {
  if (before == glm::vec3(0) || metered == glm::vec3(0)) return metered;
  constexpr float unseen = 0.03f, share = 0.2f;
  const float brightest = std::max({metered.r, metered.g, metered.b});
  const glm::vec3 off = glm::abs(metered - before);
  if (std::max({off.r, off.g, off.b}) < unseen * brightest) return before;
  return glm::mix(before, metered, share);
}

void Metering::set_target(float ev100) {
  target_ = std::clamp(ev100, min_ev100, max_ev100);
}

bool Metering::is_moving(float ev100) const {
  return target_ && (jumps_ || std::abs(*target_ - ev100) > seen_ev);
}

float Metering::update(float ev100, double elapsed_s) {
  if (!is_moving(ev100)) return ev100;
  if (jumps_) {
    jumps_ = false;
    return *target_;
  }
  const double share = 1 - std::exp(-elapsed_s / time_constant_s);
  return ev100 + static_cast<float>(share) * (*target_ - ev100);
}

}  // namespace nightcity::viewer
