// Plans trips through the network so that each class of road carries its share of the traffic.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tools/traffic/link_network.h"
#include "tools/traffic/vehicle_types.h"

namespace nightcity::traffic {

struct TripPlan {
  std::vector<std::size_t> links;  // lane, turn, lane, ... lane
  // The start of the vehicle's middle on the first link and its end on the last one, metres from
  // the link's start.
  double start_s = 0, end_s = 0;
  bool from_kerb = false;  // starts parked; otherwise it comes over the border or out of a dead end
  bool to_stop = false;    // ends standing; otherwise it leaves over the border
  // The distance to the right of the lane's middle at which it is parked at
  // the start and at the end.
  double start_aside_m = 0, end_aside_m = 0;
  std::size_t type = 0;  // index into vehicle_types
  double speed_factor = 1;
  double start_time_s = 0;  // planned, in [0, cycle)
  double free_time_s = 0;   // approximate duration on empty roads
  std::uint32_t id = 0;
};

/// Trips of a cycle. A whole city of 10,000 vehicles has some 40,000 in ten minutes. Planning and
/// simulating 50,000 takes about a minute of one core.
constexpr std::size_t default_max_trips = 100'000;

struct Demand {
  double vehicles = 0;  // on the road at once; 0: no traffic
  double cycle_s = 600;
  std::uint64_t seed = 1;
  std::size_t max_trips = default_max_trips;
};

struct TripPlanReport {
  std::map<std::string, double> lane_km;        // by class of road
  std::map<std::string, double> wanted, given;  // vehicles at once, by class
  std::size_t left_out = 0;           // plans that led nowhere in time or could not be driven
  std::size_t beyond_limit = 0;       // vehicles on the road at once that max_trips leaves out
  std::size_t through_buildings = 0;  // those of them with a wall in the way
  // Roads between two ends that take longer than a trip may last, so that no trip uses them, and
  // the cycle in which the slowest vehicle would get through.
  double too_long_km = 0, needed_cycle_s = 0;
};

/// Returns the number of vehicles at once at table_hour, by the table of densities.
double vehicles_by_table(const RoadGraph& graph);

/// Plans trips whose driving times on empty roads add up to demand.vehicles *
/// demand.cycle_s. They start and end at the map's border, in dead ends and at kerbs where
/// parking is allowed. They end at `max_trips`, and earlier where trips pass very many links: on
/// streets of a tenth of a metre, or for a million vehicles, plans would fill the memory.
/// Deterministic.
std::vector<TripPlan> plan_trips(LinkNetwork& network, const Demand& demand,
                                 TripPlanReport& report);

}  // namespace nightcity::traffic
