// Driving: a microscopic simulation of all routes together, with following, bends and junctions.
#pragma once

#include <functional>
#include <span>

#include "tools/traffic/link_network.h"
#include "tools/traffic/trip_plans.h"

namespace nightcity::traffic {

/// One route driven: distance along the route's links (from the start of the first) and speed, every step_s.
struct DrivenTrip {
  std::size_t plan;
  double start_time_s;  // in [0, cycle)
  std::vector<float> distance_m, speed_m_s;
};

struct SimulationReport {
  std::size_t driven = 0;
  std::size_t never_started = 0;  // no room at their start for a whole cycle
  std::size_t stuck = 0;          // not at their end within a cycle
  std::size_t steps = 0;
  std::size_t max_at_once = 0;
  double waited_s = 0;  // at their start, all together
};

/// Every route starts once a cycle. Simulated until the traffic repeats itself, then one cycle of starts is
/// handed to `sink`, each drive when it ends. Deterministic. A drive that meets the next cycle's traffic may
/// differ from that traffic as handed out; whoever plays them back checks for bodies that overlap.
SimulationReport simulate(const LinkNetwork& network, std::span<const TripPlan> plans,
                          double cycle_s, const std::function<void(DrivenTrip&&)>& sink,
                          const std::function<void(double done)>& progress = {});

}  // namespace nightcity::traffic
