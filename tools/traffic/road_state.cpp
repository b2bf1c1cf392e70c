#include "tools/traffic/road_state.h"

#include <algorithm>

namespace nightcity::traffic {
namespace {

constexpr double see_ahead_s = 8, see_least_m = 45;

}  // namespace

double sight_m(const Car& car) {
  return std::max(see_least_m, see_ahead_s * car.v);
}

RoadState::RoadState(const LinkNetwork& network) : links(network) {
  on_link.resize(links.size());
  holders.resize(links.size());
  coming.resize(links.size());
  turning.resize(network.graph().nodes.size());
}

std::uint32_t RoadState::add(const Route& route, double v) {
  auto number = static_cast<std::uint32_t>(cars.size());
  if (free_.empty()) {
    cars.emplace_back();
  } else {
    number = free_.back();
    free_.pop_back();
  }
  Car& car = cars[number];
  car = Car{};
  car.way = &route;
  car.type = &vehicle_types[route.type];
  car.half = car.type->length_m / 2;
  car.distance = route.start_s;
  car.v = v;
  car.granted = 1;
  car.born = now;
  double sum = 0;
  car.starts.reserve(route.links.size() + 1);
  for (const std::size_t link : route.links) {
    car.starts.push_back(sum);
    sum += links[link].length_m;
  }
  car.starts.push_back(sum);
  enter(number);
  active.insert(std::lower_bound(active.begin(), active.end(), number), number);
  return number;
}

void RoadState::enter(std::uint32_t number) {
  const Car& car = cars[number];
  const std::size_t link = car.way->links[car.leg];
  auto& row = on_link[link];
  const double s = car.on_leg();
  row.insert(
      std::find_if(row.begin(), row.end(), [&](std::uint32_t n) { return cars[n].on_leg() < s; }),
      number);
  if (links[link].turn) ++turning[links[link].node];
}

void RoadState::leave(std::uint32_t number) {
  const Car& car = cars[number];
  const std::size_t link = car.way->links[car.leg];
  auto& row = on_link[link];
  row.erase(std::find(row.begin(), row.end(), number));
  if (links[link].turn) --turning[links[link].node];
}

void RoadState::go_on(std::uint32_t number) {
  leave(number);
  ++cars[number].leg;
  enter(number);
}

void RoadState::remove(std::uint32_t number) {
  release(number, true);
  leave(number);
  active.erase(std::lower_bound(active.begin(), active.end(), number));
  free_.push_back(number);
}

void RoadState::hold(std::uint32_t number, std::size_t leg) {
  holders[cars[number].way->links[leg]].push_back({number, static_cast<std::uint32_t>(leg)});
}

void RoadState::drop(std::uint32_t number, std::size_t leg) {
  const std::size_t link = cars[number].way->links[leg];
  if (links[link].junction)
    std::erase_if(holders[link],
                  [&](const Hold& hold) { return hold.car == number && hold.leg == leg; });
}

void RoadState::release(std::uint32_t number, bool all) {
  Car& car = cars[number];
  while (
      car.held_from < car.granted &&
      (all || (car.held_from < car.leg && car.distance - car.half > car.starts[car.held_from + 1])))
    drop(number, car.held_from++);
}

void RoadState::look_ahead() {
  for (const std::size_t link : touched_) coming[link].clear();
  touched_.clear();
  for (const std::uint32_t number : active) {
    const Car& car = cars[number];
    // Nobody waits for one who stands in a queue.
    const double far = car.v < standing_m_s ? car.half + line_m : sight_m(car);
    for (std::size_t leg = car.leg + 1; leg < car.way->links.size() && car.way_to(leg) < far;
         ++leg) {
      const std::size_t link = car.way->links[leg];
      if (!links[link].junction) continue;
      if (coming[link].empty()) touched_.push_back(link);
      coming[link].push_back({number, car.way_to(leg)});
    }
  }
}

}  // namespace nightcity::traffic
