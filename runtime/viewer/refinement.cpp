#include "runtime/viewer/refinement.h"

#include <algorithm>

namespace nightcity::viewer {
namespace {

// A full frame takes about this many times a quick one's time (measured: docs/window.md).
constexpr double full_over_quick = 3;

}  // namespace

void Refinement::change(double now_s) {
  changed_s_ = now_s;
  shown_.reset();
}

void Refinement::complete(const FramePlan& plan, double pixels, double seconds, bool is_present) {
  if (is_present) shown_ = plan;
  if (pixels > 0) pixel_s_[plan.quick] = seconds / pixels;
}

std::optional<double> Refinement::frame_s(const FramePlan& plan, double pixels) const {
  const double rendered = pixels / (double(plan.divisor) * plan.divisor);
  const double own = pixel_s_[plan.quick], other = pixel_s_[!plan.quick];
  if (own > 0) return own * rendered;
  if (other > 0) return other * rendered * (plan.quick ? 1 / full_over_quick : full_over_quick);
  return std::nullopt;
}

FramePlan Refinement::plan_moving(double pixels) const {
  if (fixed_ != 0) return {fixed_, false};
  const auto fits = [&](const FramePlan& plan) {
    const std::optional<double> seconds = frame_s(plan, pixels);
    return seconds && *seconds <= moving_frame_s;
  };
  for (const std::uint32_t divisor : {1u, 2u, 4u, 8u}) {
    if (fits({divisor, false})) return {divisor, false};
    if (fits({divisor, true})) return {divisor, true};
  }
  return {coarsest, true};
}

FramePlan Refinement::plan(double now_s, double pixels, bool runs) const {
  const FramePlan moving = plan_moving(pixels);
  if (runs || !shown_ || is_moving(now_s)) return moving;
  const std::uint32_t finest = fixed_ != 0 ? fixed_ : 1;
  if (shown_->divisor <= finest) return {finest, false};
  // From the coarsest picture there is one step before every pixel has its own: two would take a
  // fourth of the last step's time more.
  constexpr std::uint32_t between = 4;
  const FramePlan next{std::max(finest, shown_->divisor > between ? between : 1), true};
  const FramePlan full{next.divisor, false};
  const std::optional<double> seconds = frame_s(full, pixels);
  return seconds && *seconds <= moving_frame_s ? full : next;
}

bool Refinement::is_worth_giving_up(const FramePlan& plan, double pixels) const {
  const FramePlan quickest = plan_moving(pixels);
  const double limit_s = std::max(moving_frame_s, frame_s(quickest, pixels).value_or(0));
  return plan != quickest && frame_s(plan, pixels).value_or(0) > 1.5 * limit_s;
}

bool Refinement::is_fine() const {
  return shown_ && shown_->divisor <= (fixed_ != 0 ? fixed_ : 1) && !shown_->quick;
}

}  // namespace nightcity::viewer
