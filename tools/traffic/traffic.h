// The traffic of a city: from its streets to the records of the light file.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/light_file.h"
#include "tools/lights/photometry.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"
#include "tools/traffic/overlaps.h"
#include "tools/traffic/road_graph.h"
#include "tools/traffic/simulation.h"
#include "tools/traffic/trip_knots.h"
#include "tools/traffic/trip_plans.h"

namespace nightcity::traffic {

struct TrafficOptions {
  std::optional<double> vehicles;  // on the road at 22:00; empty: by the table of densities
  std::optional<double> per_km;    // vehicles per km of lane at 22:00, over all roads
  double cycle_s = 600;
  int max_trips = static_cast<int>(default_max_trips);  // planned in a cycle
  std::optional<Side> side;                             // empty: by country
  std::uint64_t seed = 1;
  std::array<float, 24> hours = flow_by_hour;  // share of the busiest hour from noon on
  KnotTolerance tolerance;
};

struct TrafficReport {
  std::map<std::string, std::size_t> left_out;  // ways, by reason
  std::size_t nodes = 0, edges = 0, links = 0;
  std::string country;
  Side side = Side::right;
  TripPlanReport plans;
  SimulationReport simulation;
  KnotError knot_error;
  KnotTolerance tolerance;
  std::size_t trips = 0, knots = 0, brakings = 0;
  double driven_km = 0, cycle_s = 0;
  // Length of all lanes and turns, and of those that touch a building, on which nobody drives.
  double links_km = 0, links_in_buildings_km = 0;
  double mean_vehicles = 0;                    // with every trip on the road
  std::array<double, 24> vehicles_by_hour{};   // from noon
  std::map<std::string, std::size_t> by_type;  // number of trips
  std::size_t overlap_samples = 0, overlapping = 0, overlaps_left_out = 0;
  double mean_speed_m_s = 0;
  std::vector<std::pair<std::string, double>> seconds;  // by step
};

/// Owns the records that LightFileContent::traffic refers to.
struct TrafficSet {
  TrafficCycle cycle{};
  std::vector<VehicleKind> vehicles;
  std::vector<Light> vehicle_lights;
  std::vector<Trip> trips;
  std::vector<TripKnot> knots;
  lights::ProfileTable profiles;  // of the vehicles' lights
  TrafficReport report;

  TrafficContent content() const { return {cycle, vehicles, vehicle_lights, trips, knots}; }
};

using StepProgress = std::function<void(const char* step, double share)>;

/// Makes the traffic of all drivable ways. `to_frame`, `height_at` and `inside` are those of
/// place_lamps; `deck_at` is that of LinkNetwork. Without a drivable road the set is empty. Throws
/// Error if there are more trips than a light file can count.
TrafficSet make_traffic(const std::vector<osm::OsmWay>& highways,
                        const place::LonLatToFrame& to_frame, const place::HeightAt& height_at,
                        const place::InsideBuilding& inside, const TrafficOptions& options,
                        const Georeference& georeference, const StepProgress& progress = {},
                        const place::DeckAt& deck_at = {});

}  // namespace nightcity::traffic
