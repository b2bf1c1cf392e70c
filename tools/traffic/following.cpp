#include "tools/traffic/following.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "tools/traffic/driver_model.h"

namespace nightcity::traffic {
namespace {

constexpr double line_gap_m = 0.7;  // from the bumper to the stop line

struct Leader {
  double gap = 1e9, speed = 0;
  void consider(double other_gap, double other_speed) {
    if (other_gap < gap) {
      gap = other_gap;
      speed = other_speed;
    }
  }
};

/// Considers vehicles on conflicting turns. A vehicle that leaves the same lane by another turn, or
/// enters the same lane from another, is followed as if it drove ahead while its body is in the
/// way. For a vehicle that still stands across the turn, this one stops.
void consider_conflicts(const RoadState& roads, const Vehicle& vehicle, std::size_t turn,
                        double distance, Leader& leader) {
  for (const Conflict& conflict : roads.links.conflicts(turn)) {
    for (std::uint32_t number = roads.foremost[conflict.other]; number != no_vehicle;
         number = roads.vehicles[number].behind) {
      const Vehicle& other = roads.vehicles[number];
      const double s = other.on_leg();
      if (conflict.kind == Conflict::Kind::cross) {
        const double before = distance + conflict.begin - vehicle.half_length;
        if (before > 0 && s + other.half_length > conflict.other_begin &&
            s - other.half_length < conflict.other_end)
          leader.consider(before, 0);
      } else if (conflict.kind == Conflict::Kind::diverge) {
        if (s - other.half_length > conflict.other_end || distance + s <= 0.01) continue;
        leader.consider(distance + s - other.half_length - vehicle.half_length, other.v);
      } else {
        const double left = roads.links[conflict.other].length_m - s;
        const double own_left = distance + roads.links[turn].length_m;
        if (left >= own_left) continue;
        leader.consider(own_left - left - other.half_length - vehicle.half_length, other.v);
      }
    }
  }
}

Leader find_leader(const RoadState& roads, const Vehicle& vehicle) {
  Leader leader;
  const double far = sight_m(vehicle);
  for (std::size_t n = vehicle.leg; n < vehicle.leg_count() && vehicle.distance_to(n) < far; ++n) {
    const Leg& leg = vehicle.legs[n];
    const double distance = vehicle.distance_to(n);
    const std::uint32_t number = n == vehicle.leg ? vehicle.ahead : roads.rearmost[leg.link];
    if (number != no_vehicle) {
      const Vehicle& next = roads.vehicles[number];
      leader.consider(distance + next.on_leg() - next.half_length - vehicle.half_length, next.v);
    }
    if (leg.turn && roads.turning[leg.node] > 0)
      consider_conflicts(roads, vehicle, leg.link, distance, leader);
    if (number != no_vehicle) break;
  }
  return leader;
}

/// Returns the speed from which a vehicle can still stop comfortably within `distance` metres.
double stopping_speed(double distance) {
  return distance < 0.2 ? 0.0 : std::sqrt(2 * comfortable_braking * (distance - 0.1));
}

/// Returns the speed that bends, stop lines and the trip's end allow after this step.
double speed_cap(const RoadState& roads, Vehicle& vehicle) {
  const double factor = vehicle.speed_factor, step = vehicle.v * step_s, far = sight_m(vehicle);
  double cap = factor * roads.links.speed_allowed(vehicle.legs[vehicle.leg].link,
                                                  vehicle.on_leg() + step, vehicle.limit);
  for (std::size_t n = vehicle.leg; n < vehicle.leg_count() && vehicle.distance_to(n) - step < far;
       ++n) {
    const Leg& leg = vehicle.legs[n];
    const double distance = vehicle.distance_to(n) - step;
    if (n > vehicle.leg) {
      const double entry = factor * leg.entry_m_s;
      cap = std::min(cap,
                     std::sqrt(entry * entry + 2 * comfortable_braking * std::max(distance, 0.0)));
      if (leg.turn && n >= vehicle.granted)
        return std::min(cap, stopping_speed(distance - vehicle.half_length - line_gap_m));
    }
    if (n + 1 == vehicle.leg_count() && vehicle.plan->to_stop)
      cap = std::min(cap, stopping_speed(distance + vehicle.plan->end_s));
  }
  return cap;
}

double next_speed(const RoadState& roads, Vehicle& vehicle) {
  const Leader leader = find_leader(roads, vehicle);
  if (vehicle.v == 0 && leader.gap <= standstill_gap_m)
    return 0;  // in a queue: the rules below would say the same
  const double cap = speed_cap(roads, vehicle);
  const double a = vehicle.acceleration;
  const double desired_speed =
      vehicle.speed_factor * std::max(vehicle.legs[vehicle.leg].entry_m_s, cap);
  const double share = vehicle.v / std::max(desired_speed, 1.0),
               free = 1 - share * share * share * share;
  double interaction = 0;
  if (leader.gap < 1e8) {
    const double dv = vehicle.v - leader.speed;
    const double desired =
        standstill_gap_m +
        std::max(0.0,
                 vehicle.v * headway_s + vehicle.v * dv / (2 * std::sqrt(a * comfortable_braking)));
    const double ratio = desired / std::max(leader.gap, 0.1);
    interaction = ratio * ratio;
  }
  double next = vehicle.v + a * (std::max(free, -1.0) - interaction) * step_s;
  next = std::min(next, cap);
  // Never drive into the vehicle ahead, whatever the model says.
  if (leader.gap < 0.5) next = std::min(next, leader.speed * 0.5);
  return std::max({next, vehicle.v - hardest_braking * step_s, 0.0});
}

}  // namespace

void choose_speeds(RoadState& roads) {
  oneapi::tbb::parallel_for(std::size_t{0}, roads.active.size(), [&](std::size_t n) {
    Vehicle& vehicle = roads.vehicles[roads.active[n]];
    vehicle.next_v = next_speed(roads, vehicle);
  });
}

}  // namespace nightcity::traffic
