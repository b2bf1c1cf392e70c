#include "tools/traffic/junction_rules.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "tools/traffic/driver_model.h"

namespace nightcity::traffic {
namespace {

constexpr double clear_margin_s = 1.2;  // between two vehicles whose paths cross
// Nobody waits for a vehicle that has stood at its line for longer than this.
constexpr double patience_s = 1.5;
// After this time at a line, a driver no longer gives way to vehicles that are not at their line
// yet.
constexpr double lost_patience_s = 12;
constexpr double grant_within_m = 80;

/// Returns the seconds for `distance` metres, accelerating from speed v up to `max_speed`.
double travel_time(double distance, double v, double acceleration, double max_speed) {
  if (distance <= 0) return 0;
  max_speed = std::max(max_speed, 1.0);
  if (v >= max_speed) return distance / v;
  const double until = (max_speed * max_speed - v * v) / (2 * acceleration);
  if (distance <= until) return (std::sqrt(v * v + 2 * acceleration * distance) - v) / acceleration;
  return (max_speed - v) / acceleration + (distance - until) / max_speed;
}

/// Returns whether the lane behind a turn has room for one more vehicle, so that nobody stops
/// inside the junction: the free length of the lane, less what the vehicles need that are already
/// on their way there.
bool has_room_behind(const RoadState& roads, std::uint32_t number, std::size_t leg) {
  const Vehicle& vehicle = roads.vehicles[number];
  const std::uint32_t turn = vehicle.legs[leg].link, lane = vehicle.legs[leg + 1].link;
  const double needed = 2 * vehicle.half_length + 1.5;
  double room = roads.links[lane].length_m;
  if (room < needed) return true;  // nobody can ever stand there
  if (roads.rearmost[lane] != no_vehicle) {
    const Vehicle& last = roads.vehicles[roads.rearmost[lane]];
    room = last.on_leg() - last.half_length + last.v * last.v / (2 * comfortable_braking);
  }
  const auto claim = [&](std::size_t from) {
    for (const Hold& hold : roads.holders[from]) {
      const Vehicle& other = roads.vehicles[hold.vehicle];
      if (hold.vehicle != number && other.distance < other.legs[hold.leg + 1].start)
        room -= 2 * other.half_length + standstill_gap_m;
    }
  };
  claim(turn);
  for (const Conflict& conflict : roads.links.conflicts(turn))
    if (conflict.kind == Conflict::Kind::merge) claim(conflict.other);
  return room >= needed;
}

/// Returns whether `other`, which is `distance` metres before the conflict, arrives there after a
/// vehicle that has passed it in `clear` seconds.
bool comes_late(const Vehicle& other, double distance, double clear) {
  return distance > 0 && travel_time(distance, other.v, other.acceleration,
                                     std::max(other.v, 5.0)) > clear + clear_margin_s;
}

/// Grants the turns that conflict with none. At the first junction `ask` decides.
template <class Ask>
void grant_turns_of(RoadState& roads, std::uint32_t number, const Ask& ask) {
  Vehicle& vehicle = roads.vehicles[number];
  vehicle.request = Vehicle::Request::none;
  const double needed =
      vehicle.v * vehicle.v / (2 * comfortable_braking) + vehicle.v * 1.0 + vehicle.half_length + 4;
  for (std::size_t leg = std::max(vehicle.leg + 1, vehicle.granted); leg < vehicle.leg_count();
       ++leg) {
    const Leg& link = vehicle.legs[leg];
    if (!link.turn) continue;
    const double distance = vehicle.distance_to(leg);
    if (distance > needed || distance > grant_within_m) return;
    if (link.junction && !ask(leg, distance)) return;
    vehicle.granted = static_cast<std::uint32_t>(leg) + 1;
  }
}

}  // namespace

bool may_go(const RoadState& roads, std::uint32_t number, std::size_t leg) {
  const Vehicle& vehicle = roads.vehicles[number];
  const std::uint32_t turn = vehicle.legs[leg].link;
  const LinkFacts& link = roads.links[turn];
  const double distance = vehicle.distance_to(leg);
  if (!has_room_behind(roads, number, leg)) return false;
  const bool lost_patience = roads.now - vehicle.standing_since > lost_patience_s;
  const double max_speed =
      vehicle.speed_factor * roads.links.speed_allowed(turn, link.length_m / 2);
  for (const Conflict& conflict : roads.links.conflicts(turn)) {
    if (conflict.kind == Conflict::Kind::diverge) continue;
    const auto& holders = roads.holders[conflict.other];
    const bool waits = conflict.yields && !roads.coming[conflict.other].empty();
    if (holders.empty() && !waits) continue;
    const double clear = travel_time(distance + conflict.end + vehicle.half_length, vehicle.v,
                                     vehicle.acceleration, max_speed);
    for (const Hold& hold : holders) {
      const Vehicle& other = roads.vehicles[hold.vehicle];
      const double at = -other.distance_to(hold.leg);
      if (at - other.half_length > conflict.other_end) continue;
      // Both turns lead into one lane: follow the other vehicle as on a lane.
      const double left = roads.links[conflict.other].length_m - at;
      if (conflict.kind == Conflict::Kind::merge && at > 0 && left < link.length_m + distance - 1.0)
        continue;
      if (!comes_late(other, conflict.other_begin - other.half_length - at, clear)) return false;
    }
    if (!waits) continue;
    for (const Coming& coming : roads.coming[conflict.other]) {
      const Vehicle& other = roads.vehicles[coming.vehicle];
      if (coming.vehicle == number) continue;
      if (roads.now - other.standing_since > patience_s) continue;  // something else holds it up
      const bool at_line = coming.distance < other.half_length + line_m;
      if (!at_line && (lost_patience || other.v < standing_m_s)) continue;  // it stands in a queue
      if (!comes_late(other, coming.distance + conflict.other_begin - other.half_length, clear))
        return false;
    }
  }
  return true;
}

void grant_turns(RoadState& roads) {
  // Most requests are refused because of what was granted before this step: find those in parallel.
  // Then decide the others one after the other, because each grant may rule out the next.
  oneapi::tbb::parallel_for(std::size_t{0}, roads.active.size(), [&](std::size_t n) {
    const std::uint32_t number = roads.active[n];
    grant_turns_of(roads, number, [&](std::size_t leg, double distance) {
      Vehicle& vehicle = roads.vehicles[number];
      const bool stands = vehicle.v < 0.5 && distance < vehicle.half_length + 6;
      vehicle.request = may_go(roads, number, leg) ? Vehicle::Request::turn
                        : stands                   ? Vehicle::Request::waits
                                                   : Vehicle::Request::none;
      return false;
    });
  });
  std::vector<std::uint32_t> waiting;
  for (const std::uint32_t number : roads.active) {
    Vehicle& vehicle = roads.vehicles[number];
    if (vehicle.request == Vehicle::Request::turn)
      grant_turns_of(roads, number, [&](std::size_t leg, double distance) {
        if (may_go(roads, number, leg)) {
          roads.hold(number, leg);
          return true;
        }
        if (vehicle.v < 0.5 && distance < vehicle.half_length + 6)
          vehicle.request = Vehicle::Request::waits;
        return false;
      });
    if (vehicle.request == Vehicle::Request::waits) waiting.push_back(number);
  }
  // Update the waiting times at the end, so that no decision depends on the order of the requests.
  for (const std::uint32_t number : roads.active)
    if (roads.vehicles[number].request != Vehicle::Request::waits)
      roads.vehicles[number].standing_since = not_standing;
  for (const std::uint32_t number : waiting)
    roads.vehicles[number].standing_since =
        std::min(roads.vehicles[number].standing_since, roads.now);
}

}  // namespace nightcity::traffic
