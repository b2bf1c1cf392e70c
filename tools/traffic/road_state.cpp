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
  on_link.resize(links.size());
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
  vehicle.type = &vehicle_types[plan.type];
  vehicle.half_length = vehicle.type->length_m / 2;
  vehicle.distance = plan.start_s;
  vehicle.v = v;
  vehicle.granted = 1;
  vehicle.born = now;
  double sum = 0;
  vehicle.starts.reserve(plan.links.size() + 1);
  for (const std::size_t link : plan.links) {
    vehicle.starts.push_back(sum);
    sum += links[link].length_m;
  }
  vehicle.starts.push_back(sum);
  enter(number);
  active.insert(std::lower_bound(active.begin(), active.end(), number), number);
  return number;
}

void RoadState::enter(std::uint32_t number) {
  const Vehicle& vehicle = vehicles[number];
  const std::size_t link = vehicle.plan->links[vehicle.leg];
  auto& row = on_link[link];
  const double s = vehicle.on_leg();
  row.insert(std::find_if(row.begin(), row.end(),
                          [&](std::uint32_t n) { return vehicles[n].on_leg() < s; }),
             number);
  if (links[link].turn) ++turning[links[link].node];
}

void RoadState::leave(std::uint32_t number) {
  const Vehicle& vehicle = vehicles[number];
  const std::size_t link = vehicle.plan->links[vehicle.leg];
  auto& row = on_link[link];
  row.erase(std::find(row.begin(), row.end(), number));
  if (links[link].turn) --turning[links[link].node];
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
  holders[vehicles[number].plan->links[leg]].push_back({number, static_cast<std::uint32_t>(leg)});
}

void RoadState::drop(std::uint32_t number, std::size_t leg) {
  const std::size_t link = vehicles[number].plan->links[leg];
  if (links[link].junction)
    std::erase_if(holders[link],
                  [&](const Hold& hold) { return hold.vehicle == number && hold.leg == leg; });
}

void RoadState::release(std::uint32_t number, bool all) {
  Vehicle& vehicle = vehicles[number];
  while (vehicle.held_from < vehicle.granted &&
         (all || (vehicle.held_from < vehicle.leg &&
                  vehicle.distance - vehicle.half_length > vehicle.starts[vehicle.held_from + 1])))
    drop(number, vehicle.held_from++);
}

void RoadState::look_ahead() {
  for (const std::size_t link : touched_) coming[link].clear();
  touched_.clear();
  for (const std::uint32_t number : active) {
    const Vehicle& vehicle = vehicles[number];
    // Nobody waits for a vehicle that stands in a queue.
    const double far = vehicle.v < standing_m_s ? vehicle.half_length + line_m : sight_m(vehicle);
    for (std::size_t leg = vehicle.leg + 1;
         leg < vehicle.plan->links.size() && vehicle.distance_to(leg) < far; ++leg) {
      const std::size_t link = vehicle.plan->links[leg];
      if (!links[link].junction) continue;
      if (coming[link].empty()) touched_.push_back(link);
      coming[link].push_back({number, vehicle.distance_to(leg)});
    }
  }
}

}  // namespace nightcity::traffic
