// Who drives where: drives through the network so that each class of road carries its share of the traffic.
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
  double start_s = 0, end_s = 0;   // the vehicle's middle, on the first and the last link
  bool from_kerb = false;  // starts parked; else it drives in over the border or out of a dead end
  bool to_stop = false;    // ends standing; else it drives out over the border
  double start_aside_m = 0, end_aside_m = 0;  // to the right of the lane's middle, where parked
  std::size_t type = 0;                       // into vehicle_types
  double speed_factor = 1;
  double start_time_s = 0;  // wish, in [0, cycle)
  double free_time_s = 0;   // roughly, with nobody else about
  std::uint32_t id = 0;
};

struct Demand {
  double vehicles = 0;  // on the road at once; 0 = no traffic
  double cycle_s = 600;
  std::uint64_t seed = 1;
};

struct TripPlanReport {
  std::map<std::string, double> lane_km;        // by class of road
  std::map<std::string, double> wanted, given;  // vehicles at once, by class
  std::size_t rejected = 0;           // drives that led nowhere in time, or could not be driven:
  std::size_t through_buildings = 0;  // of them: a wall stood in the way
};

/// Vehicles at once at the table's hour, by the table of densities.
double vehicles_by_table(const RoadGraph& graph);

/// Drives whose free driving times add up to demand.vehicles * demand.cycle_s. They start and end at the
/// map's border, in dead ends and at kerbs where one may park. Deterministic.
std::vector<TripPlan> plan_trips(LinkNetwork& network, const Demand& demand,
                                 TripPlanReport& report);

}  // namespace nightcity::traffic
