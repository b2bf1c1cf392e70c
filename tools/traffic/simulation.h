// A microscopic simulation that drives all trips together, with following, bends and junctions.
#pragma once

#include <functional>
#include <span>

#include "tools/traffic/link_network.h"
#include "tools/traffic/trip_plans.h"

namespace nightcity::traffic {

/// A trip as it was driven: distance along the plan's links, from the start of the first, and
/// speed, every step_s seconds.
struct DrivenTrip {
  std::size_t plan;     // its number among the planned trips
  double start_time_s;  // in [0, cycle)
  std::vector<float> distance_m, speed_m_s;
};

struct SimulationReport {
  std::size_t driven = 0;
  std::size_t never_started = 0;  // trips with no room at their start for a whole cycle
  std::size_t stuck = 0;          // trips that did not end within a cycle
  std::size_t steps = 0;
  std::size_t looks = 0;  // of waiting trips for room at their start, over all steps
  std::size_t max_at_once = 0;
  double waited_s = 0;  // at the start, summed over all trips
};

/// Simulates until the traffic repeats itself; every trip starts once in each cycle. Then passes
/// the trips that start in one cycle to `sink`, each when it ends. Deterministic. A trip that
/// reaches into the next cycle meets traffic that may differ from what was passed on, so the caller
/// must check for bodies that overlap (overlaps.h).
SimulationReport simulate(const LinkNetwork& network, std::span<const TripPlan> plans,
                          double cycle_s, const std::function<void(DrivenTrip&&)>& sink,
                          const std::function<void(double done)>& progress = {});

}  // namespace nightcity::traffic
