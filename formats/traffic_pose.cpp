#include "formats/traffic_pose.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nightcity {
namespace {

double wrapped(double value, double period) {
  const double rest = value - period * std::floor(value / period);
  return rest < period ? rest : 0;  // rounding may give the period itself
}

double yaw_of(const TripKnot& knot) {
  return (knot.pose & 0xFFFFu) * (2 * std::numbers::pi / 65536);
}

double pitch_of(const TripKnot& knot) {
  return static_cast<std::int8_t>(knot.pose >> 16 & 0xFFu) / 256.0;
}

}  // namespace

double density_at(const TrafficCycle& cycle, double t) {
  const double hour = wrapped(t / 3600, 24);
  const auto before = std::min<std::size_t>(static_cast<std::size_t>(hour), 23);
  const double part = hour - static_cast<double>(before);
  return double{cycle.density[before]} * (1 - part) +
         double{cycle.density[(before + 1) % 24]} * part;
}

KnotStretch::KnotStretch(const TripKnot& a, const TripKnot& b)
    : p0_(a.position),
      p1_(b.position),
      v0_(a.velocity),
      v1_(b.velocity),
      begin_(double{a.time_s}),
      step_(double{b.time_s} - double{a.time_s}),
      yaw_(yaw_of(a)),
      turn_(std::remainder(yaw_of(b) - yaw_of(a), 2 * std::numbers::pi)),
      pitch_(pitch_of(a)),
      rise_(pitch_of(b) - pitch_of(a)),
      braking_((a.pose & KNOT_BRAKING) != 0) {}

VehiclePose pose_on_trip(std::span<const TripKnot> knots, double u) {
  u = std::clamp(u, 0.0, double{knots.back().time_s});
  const auto after =
      std::upper_bound(knots.begin() + 1, knots.end() - 1, u,
                       [](double time, const TripKnot& k) { return time < double{k.time_s}; });
  return KnotStretch(after[-1], after[0]).pose_at(u);
}

std::optional<double> find_trip_time(const TrafficContent& traffic, const Trip& trip, double t) {
  const double u = wrapped(t - double{trip.start_s}, double{traffic.cycle.cycle_s});
  const TripKnot& last = traffic.knots[trip.first_knot + trip.knot_count - 1];
  if (u >= double{last.time_s} || density_at(traffic.cycle, t - u) <= double{trip.rank})
    return std::nullopt;
  return u;
}

std::optional<VehiclePose> pose_at(const TrafficContent& traffic, const Trip& trip, double t) {
  const auto u = find_trip_time(traffic, trip, t);
  if (!u) return std::nullopt;
  return pose_on_trip(traffic.knots.subspan(trip.first_knot, trip.knot_count), *u);
}

glm::dmat4 to_model(const VehiclePose& pose) {
  const double cy = std::cos(pose.yaw), sy = std::sin(pose.yaw);
  const double cp = std::cos(pose.pitch), sp = std::sin(pose.pitch);
  const glm::dvec3 forward(cy * cp, sp, -sy * cp), right(sy, 0, cy);
  return {glm::dvec4(forward, 0), glm::dvec4(glm::cross(right, forward), 0), glm::dvec4(right, 0),
          glm::dvec4(pose.position, 1)};
}

}  // namespace nightcity
