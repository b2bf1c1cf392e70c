#include "tools/traffic/trip_path.h"

#include <algorithm>

namespace nightcity::traffic {
namespace {

constexpr double pull_out_m = 16;  // from the kerb to the lane's middle

/// A smooth step from 1 at x = 0 to 0 at x = 1 and beyond; value and slope are continuous.
struct Ramp {
  double value, slope;
};
Ramp ramp(double x) {
  if (x <= 0) return {1, 0};
  if (x >= 1) return {0, 0};
  return {1 - x * x * (3 - 2 * x), -6 * x * (1 - x)};
}

}  // namespace

TripPath::TripPath(const LinkNetwork& network, const TripPlan& plan)
    : network_(network), plan_(plan) {
  double sum = 0;
  for (const std::size_t link : plan.links) {
    starts_.push_back(sum);
    sum += network.links()[link].curve.length();
  }
  starts_.push_back(sum);
  if (plan.start_aside_m != 0)
    start_rise_m_ = network.find_rise_m(plan.links.front(), plan.start_s, plan.start_aside_m);
  if (plan.end_aside_m != 0)
    end_rise_m_ = network.find_rise_m(plan.links.back(), plan.end_s, plan.end_aside_m);
}

void TripPath::add(double aside_m, double rise_m, double share, double share_slope, Aside& sum) {
  sum.shift += aside_m * share;
  sum.slope += aside_m * share_slope;
  sum.rise += rise_m * share;
  sum.rise_slope += rise_m * share_slope;
}

TripPath::Aside TripPath::aside(double distance_m) const {
  Aside result{};
  if (plan_.start_aside_m != 0) {
    const Ramp out = ramp((distance_m - plan_.start_s) / pull_out_m);
    add(plan_.start_aside_m, start_rise_m_, out.value, out.slope / pull_out_m, result);
  }
  if (plan_.end_aside_m != 0) {
    const double end = starts_[starts_.size() - 2] + plan_.end_s;
    const Ramp in = ramp((end - distance_m) / pull_out_m);
    add(plan_.end_aside_m, end_rise_m_, in.value, -in.slope / pull_out_m, result);
  }
  return result;
}

Curve::Place TripPath::at(double distance_m) const {
  const auto after = std::upper_bound(starts_.begin() + 1, starts_.end() - 1, distance_m);
  const auto n = static_cast<std::size_t>(after - starts_.begin()) - 1;
  Curve::Place place = network_.links()[plan_.links[n]].curve.at(distance_m - starts_[n]);
  const Aside shift = aside(distance_m);
  if (shift.shift != 0 || shift.slope != 0) {
    // A lane is nearly straight where vehicles park, so the turning of its normal is neglected.
    const glm::dvec3 right(place.along.y, -place.along.x, 0);
    place.point += right * shift.shift + glm::dvec3(0, 0, shift.rise);
    place.along += right * shift.slope + glm::dvec3(0, 0, shift.rise_slope);
  }
  return place;
}

}  // namespace nightcity::traffic
