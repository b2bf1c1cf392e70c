#include "runtime/viewer/metering.h"

#include <algorithm>
#include <cmath>

#include "runtime/measure/exposure.h"

namespace nightcity::viewer {
namespace {

constexpr float emitters_over_ev = 6;
constexpr float seen_ev = 0.05f;          // a difference that is not seen
constexpr double time_constant_s = 0.43;  // 1 - exp(-1 / 0.43) = 0.9

}  // namespace

float meter_picture(const measure::Image& picture) {
  float ev100 = measure::auto_exposure_ev100(picture);
  if (const measure::ImageLayer* emitters = picture.layer("emitter")) {
    measure::Image lit;
    for (std::size_t i = 0; i < picture.pixels(); ++i)
      if (emitters->values[i] == 0)
        lit.rgb.insert(lit.rgb.end(), &picture.rgb[3 * i], &picture.rgb[3 * i] + 3);
    lit.width = static_cast<std::uint32_t>(lit.rgb.size() / 3);
    lit.height = 1;
    if (lit.width > 0)
      ev100 = std::max(measure::auto_exposure_ev100(lit), ev100 - emitters_over_ev);
  }
  return std::clamp(ev100, min_ev100, max_ev100);
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
