#include "tools/traffic/junction_rules.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "tools/traffic/driver_model.h"

namespace nightcity::traffic {
namespace {

constexpr double clear_margin_s = 1.2;  // between two who cross
constexpr double patience_s = 1.5;      // one who stands so long at a line is waited for no longer
constexpr double lost_patience_s = 12;  // then one goes where there is just room
constexpr double grant_within_m = 80;

/// Seconds for `way` metres from speed v, speeding up to `most`.
double travel_time(double way, double v, double acceleration, double most) {
  if (way <= 0) return 0;
  most = std::max(most, 1.0);
  if (v >= most) return way / v;
  const double until = (most * most - v * v) / (2 * acceleration);
  if (way <= until) return (std::sqrt(v * v + 2 * acceleration * way) - v) / acceleration;
  return (most - v) / acceleration + (way - until) / most;
}

/// Room behind a junction for one more, so that nobody stops amid it: what is free of the lane the turn
/// leads to, less those who are already on their way there.
bool room_behind(const RoadState& roads, std::uint32_t number, std::size_t leg) {
  const Vehicle& vehicle = roads.vehicles[number];
  const std::size_t turn = vehicle.plan->links[leg], lane = vehicle.plan->links[leg + 1];
  const double needed = 2 * vehicle.half + 1.5;
  double room = roads.links[lane].length_m;
  if (room < needed) return true;  // too short to stand on, at any time
  if (!roads.on_link[lane].empty()) {
    const Vehicle& last = roads.vehicles[roads.on_link[lane].back()];
    room = last.on_leg() - last.half + last.v * last.v / (2 * comfortable_braking);
  }
  const auto claim = [&](std::size_t from) {
    for (const Hold& hold : roads.holders[from]) {
      const Vehicle& other = roads.vehicles[hold.vehicle];
      if (hold.vehicle != number && other.distance < other.starts[hold.leg + 1])
        room -= 2 * other.half + standstill_gap_m;
    }
  };
  claim(turn);
  for (const Conflict& conflict : roads.links.conflicts(turn))
    if (conflict.kind == Conflict::Kind::merge) claim(conflict.other);
  return room >= needed;
}

/// Whether a car that is `way` before the conflict comes so late that one who is through after `clear`
/// seconds does not hinder it.
bool comes_late(const Vehicle& other, double way, double clear) {
  return way > 0 && travel_time(way, other.v, other.type->acceleration, std::max(other.v, 5.0)) >
                        clear + clear_margin_s;
}

/// Grants what needs no one's leave; asks for the first junction, which `ask` grants or not.
template <class Ask>
void go_through(RoadState& roads, std::uint32_t number, const Ask& ask) {
  Vehicle& vehicle = roads.vehicles[number];
  const auto& legs = vehicle.plan->links;
  vehicle.wish = Vehicle::Wish::nothing;
  const double needed =
      vehicle.v * vehicle.v / (2 * comfortable_braking) + vehicle.v * 1.0 + vehicle.half + 4;
  for (std::size_t leg = std::max(vehicle.leg + 1, vehicle.granted); leg < legs.size(); ++leg) {
    const LinkFacts& link = roads.links[legs[leg]];
    if (!link.turn) continue;
    const double way = vehicle.way_to(leg);
    if (way > needed || way > grant_within_m) return;
    if (link.junction && !ask(leg, way)) return;
    vehicle.granted = leg + 1;
  }
}

}  // namespace

bool may_go(const RoadState& roads, std::uint32_t number, std::size_t leg) {
  const Vehicle& vehicle = roads.vehicles[number];
  const std::size_t turn = vehicle.plan->links[leg];
  const LinkFacts& link = roads.links[turn];
  const double way = vehicle.way_to(leg);
  if (!room_behind(roads, number, leg)) return false;
  const bool lost_patience = roads.now - vehicle.standing_since > lost_patience_s;
  const double most =
      vehicle.plan->speed_factor * roads.links.speed_allowed(turn, link.length_m / 2);
  for (const Conflict& conflict : roads.links.conflicts(turn)) {
    if (conflict.kind == Conflict::Kind::diverge) continue;
    const auto& holders = roads.holders[conflict.other];
    const bool waits = conflict.yields && !roads.coming[conflict.other].empty();
    if (holders.empty() && !waits) continue;
    const double clear =
        travel_time(way + conflict.end + vehicle.half, vehicle.v, vehicle.type->acceleration, most);
    for (const Hold& hold : holders) {
      const Vehicle& other = roads.vehicles[hold.vehicle];
      const double at = -other.way_to(hold.leg);
      if (at - other.half > conflict.other_end) continue;
      // Into one lane: behind it, as one follows on a lane.
      const double left = roads.links[conflict.other].length_m - at;
      if (conflict.kind == Conflict::Kind::merge && at > 0 && left < link.length_m + way - 1.0)
        continue;
      if (!comes_late(other, conflict.other_begin - other.half - at, clear)) return false;
    }
    if (!waits) continue;
    for (const Coming& coming : roads.coming[conflict.other]) {
      const Vehicle& other = roads.vehicles[coming.vehicle];
      if (coming.vehicle == number) continue;
      if (roads.now - other.standing_since > patience_s) continue;  // something else keeps it
      const bool at_line = coming.distance < other.half + line_m;
      if (!at_line && (lost_patience || other.v < standing_m_s))
        continue;  // or stands in a queue itself
      if (!comes_late(other, coming.distance + conflict.other_begin - other.half, clear))
        return false;
    }
  }
  return true;
}

void grant_turns(RoadState& roads) {
  // Most of those who ask are refused by what stood before this step: that is found side by side. The others
  // are asked again one after the other, since who gets a turn shuts it to the next.
  oneapi::tbb::parallel_for(std::size_t{0}, roads.active.size(), [&](std::size_t n) {
    const std::uint32_t number = roads.active[n];
    go_through(roads, number, [&](std::size_t leg, double way) {
      Vehicle& vehicle = roads.vehicles[number];
      const bool stands = vehicle.v < 0.5 && way < vehicle.half + 6;
      vehicle.wish = may_go(roads, number, leg) ? Vehicle::Wish::turn
                     : stands                   ? Vehicle::Wish::stands
                                                : Vehicle::Wish::nothing;
      return false;
    });
  });
  std::vector<std::uint32_t> waiting;
  for (const std::uint32_t number : roads.active) {
    Vehicle& vehicle = roads.vehicles[number];
    if (vehicle.wish == Vehicle::Wish::turn)
      go_through(roads, number, [&](std::size_t leg, double way) {
        if (may_go(roads, number, leg)) {
          roads.hold(number, leg);
          return true;
        }
        if (vehicle.v < 0.5 && way < vehicle.half + 6) vehicle.wish = Vehicle::Wish::stands;
        return false;
      });
    if (vehicle.wish == Vehicle::Wish::stands) waiting.push_back(number);
  }
  // Told at the end: what one decides does not hang on who was asked before.
  for (const std::uint32_t number : roads.active)
    if (roads.vehicles[number].wish != Vehicle::Wish::stands)
      roads.vehicles[number].standing_since = not_standing;
  for (const std::uint32_t number : waiting)
    roads.vehicles[number].standing_since =
        std::min(roads.vehicles[number].standing_since, roads.now);
}

}  // namespace nightcity::traffic
