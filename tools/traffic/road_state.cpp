#include "tools/traffic/road_state.h"

#include <algorithm>

namespace nightcity::traffic {
namespace {

constexpr double see_ahead_s = 8, min_sight_m = 45;

}  // namespace

double sight_m(const Vehicle& vehicle) {
  return std::max(min_sight_m, see_ahead_s * vehicle.v);
}

RoadState::RoadState(const LinkNetwork& network) : links(network) {
  foremost.assign(links.size(), no_vehicle);
  rearmost.assign(links.size(), no_vehicle);
  holders.resize(links.size());
  coming.resize(links.size());
  turning.resize(network.graph().nodes.size());
}

std::uint32_t RoadState::add(const TripPlan& plan, double v) {
  auto number = static_cast<std::uint32_t>(vehicles.size());
  if (free_.empty()) {
    vehicles.emplace_back();
  } else {
    number = free_.back();
    free_.pop_back();
  }
  Vehicle& vehicle = vehicles[number];
  vehicle = Vehicle{};
  vehicle.plan = &plan;
  vehicle.acceleration = vehicle_types[plan.type].acceleration;
  vehicle.half_length = vehicle_types[plan.type].length_m / 2;
  vehicle.speed_factor = plan.speed_factor;
  vehicle.distance = plan.start_s;
  vehicle.v = v;
  vehicle.granted = 1;
  vehicle.born = now;
  double sum = 0;
  vehicle.legs.reserve(plan.links.size() + 1);
  for (const std::size_t link : plan.links) {
    const LinkFacts& facts = links[link];
    vehicle.legs.push_back({sum, facts.entry_m_s, static_cast<std::uint32_t>(link), facts.node,
                            facts.turn, facts.junction});
    sum += facts.length_m;
  }
  vehicle.legs.emplace_back().start = sum;
  enter(number);
  active.insert(std::lower_bound(active.begin(), active.end(), number), number);
  return number;
}

void RoadState::enter(std::uint32_t number) {
  Vehicle& vehicle = vehicles[number];
  const Leg& leg = vehicle.legs[vehicle.leg];
  vehicle.leg_start = leg.start;
  vehicle.limit = 0;
  const double s = vehicle.on_leg();
  std::uint32_t behind = foremost[leg.link];
  while (behind != no_vehicle && !(vehicles[behind].on_leg() < s)) behind = vehicles[behind].behind;
  vehicle.behind = behind;
  vehicle.ahead = behind == no_vehicle ? rearmost[leg.link] : vehicles[behind].ahead;
  (behind == no_vehicle ? rearmost[leg.link] : vehicles[behind].ahead) = number;
  (vehicle.ahead == no_vehicle ? foremost[leg.link] : vehicles[vehicle.ahead].behind) = number;
  if (leg.turn) ++turning[leg.node];
}

void RoadState::leave(std::uint32_t number) {
  const Vehicle& vehicle = vehicles[number];
  const Leg& leg = vehicle.legs[vehicle.leg];
  (vehicle.behind == no_vehicle ? rearmost[leg.link] : vehicles[vehicle.behind].ahead) =
      vehicle.ahead;
  (vehicle.ahead == no_vehicle ? foremost[leg.link] : vehicles[vehicle.ahead].behind) =
      vehicle.behind;
  if (leg.turn) --turning[leg.node];
}

void RoadState::go_on(std::uint32_t number) {
  leave(number);
  ++vehicles[number].leg;
  enter(number);
}

void RoadState::remove(std::uint32_t number) {
  release(number, true);
  leave(number);
  active.erase(std::lower_bound(active.begin(), active.end(), number));
  free_.push_back(number);
}

void RoadState::hold(std::uint32_t number, std::size_t leg) {
  holders[vehicles[number].legs[leg].link].push_back({number, static_cast<std::uint32_t>(leg)});
}

void RoadState::drop(std::uint32_t number, std::size_t leg) {
  const Leg& held = vehicles[number].legs[leg];
  if (held.junction)
    std::erase_if(holders[held.link],
                  [&](const Hold& hold) { return hold.vehicle == number && hold.leg == leg; });
}

void RoadState::release(std::uint32_t number, bool all) {
  Vehicle& vehicle = vehicles[number];
  while (
      vehicle.held_from < vehicle.granted &&
      (all || (vehicle.held_from < vehicle.leg &&
               vehicle.distance - vehicle.half_length > vehicle.legs[vehicle.held_from + 1].start)))
    drop(number, vehicle.held_from++);
}

void RoadState::look_ahead() {
  for (const std::size_t link : touched_) coming[link].clear();
  touched_.clear();
  for (const std::uint32_t number : active) {
    const Vehicle& vehicle = vehicles[number];
    // Nobody waits for a vehicle that stands in a queue.
    const double far = vehicle.v < standing_m_s ? vehicle.half_length + line_m : sight_m(vehicle);
    for (std::size_t leg = vehicle.leg + std::size_t{1};
         leg < vehicle.leg_count() && vehicle.distance_to(leg) < far; ++leg) {
      if (!vehicle.legs[leg].junction) continue;
      const std::uint32_t link = vehicle.legs[leg].link;
      if (coming[link].empty()) touched_.push_back(link);
      coming[link].push_back({number, vehicle.distance_to(leg)});
    }
  }
}

}  // namespace nightcity::traffic
