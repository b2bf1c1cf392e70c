#include "tools/traffic/traffic.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/error.h"
#include "formats/free_memory.h"
#include "formats/traffic_pose.h"
#include "tools/random.h"
#include "tools/stopwatch.h"
#include "tools/traffic/link_network.h"
#include "tools/traffic/vehicle_lamps.h"

namespace nightcity::traffic {
namespace {

constexpr double overlap_step_s = 0.5, overlap_slack_m = 0.08;

class Clock {
 public:
  explicit Clock(TrafficReport& report) : report_(report) {}
  void lap(const char* step) { report_.seconds.emplace_back(step, watch_.lap_s()); }

 private:
  TrafficReport& report_;
  Stopwatch watch_;
};

/// Returns the number of vehicles at once in the busiest hour; the table is for 22:00.
double busiest_vehicles(const RoadGraph& graph, const TrafficOptions& options) {
  const auto max_share = double{*std::max_element(options.hours.begin(), options.hours.end())};
  const auto at_table_hour = double{options.hours[(table_hour + 12) % 24]};
  double wanted = vehicles_by_table(graph);
  if (options.per_km) wanted = *options.per_km * graph.lane_km();
  if (options.vehicles) wanted = *options.vehicles;
  return at_table_hour > 0 ? wanted * max_share / at_table_hour : wanted;
}

/// Gives trips evenly spread ranks, so that an hour's share of the trips is exact and not random.
/// The order is by identity, so that a trip nearly keeps its rank when others are left out.
void rank_trips(std::vector<Trip>& trips) {
  std::vector<std::size_t> by_lot(trips.size());
  for (std::size_t n = 0; n < trips.size(); ++n) by_lot[n] = n;
  std::stable_sort(by_lot.begin(), by_lot.end(), [&](std::size_t a, std::size_t b) {
    return mix(trips[a].id) < mix(trips[b].id);
  });
  for (std::size_t k = 0; k < by_lot.size(); ++k)
    trips[by_lot[k]].rank = std::min(
        static_cast<float>((static_cast<double>(k) + 0.5) / static_cast<double>(by_lot.size())),
        0.99999994f);
}

/// Removes the marked trips and their knots, in place.
void leave_out(TrafficSet& set, const std::vector<bool>& marked) {
  std::size_t trips = 0, knots = 0;
  for (std::size_t n = 0; n < set.trips.size(); ++n) {
    if (marked[n]) continue;
    Trip trip = set.trips[n];
    const auto first = set.knots.begin() + static_cast<std::ptrdiff_t>(trip.first_knot);
    std::copy(first, first + static_cast<std::ptrdiff_t>(trip.knot_count),
              set.knots.begin() + static_cast<std::ptrdiff_t>(knots));
    trip.first_knot = static_cast<uint>(knots);
    knots += trip.knot_count;
    set.trips[trips++] = trip;
  }
  set.trips.resize(trips);
  set.knots.resize(knots);
}

/// Turns driven trips into records of the light file, many in parallel.
class TripMaker {
 public:
  TripMaker(const LinkNetwork& network, std::span<const TripPlan> plans,
            const Georeference& georeference, const TrafficOptions& options, TrafficReport& report)
      : network_(network),
        plans_(plans),
        georeference_(georeference),
        options_(options),
        report_(report) {}

  void add(DrivenTrip&& trip) {
    waiting_.push_back(std::move(trip));
    if (waiting_.size() >= batch_size) fit();
  }

  /// Moves the trips into `set`, in the order of their plans, whatever order they ended in.
  void finish(TrafficSet& set) {
    fit();
    std::stable_sort(fitted_.begin(), fitted_.end(),
                     [](const FittedTrip& a, const FittedTrip& b) { return a.plan < b.plan; });
    std::size_t knots = 0;
    for (const FittedTrip& one : fitted_) knots += one.knots.size();
    if (knots > std::numeric_limits<uint>::max())
      throw Error("", "traffic", "more trips than a light file can count: ask for fewer vehicles");
    set.knots.reserve(knots);
    set.trips.reserve(fitted_.size());
    for (FittedTrip& one : fitted_) {
      one.trip.first_knot = static_cast<uint>(set.knots.size());
      one.trip.knot_count = static_cast<uint>(one.knots.size());
      set.knots.insert(set.knots.end(), one.knots.begin(), one.knots.end());
      free_memory(one.knots);  // two copies of all knots would take too much
      set.trips.push_back(one.trip);
    }
    free_memory(fitted_);
  }

 private:
  static constexpr std::size_t batch_size = 512;  // trips kept as steps, at 8 bytes a step

  struct FittedTrip {
    std::size_t plan;
    Trip trip;
    std::vector<TripKnot> knots;
    KnotError error;
  };

  void fit() {
    std::vector<FittedTrip> batch(waiting_.size());
    oneapi::tbb::parallel_for(std::size_t{0}, waiting_.size(), [&](std::size_t n) {
      const DrivenTrip& trip = waiting_[n];
      const TripPlan& plan = plans_[trip.plan];
      FittedTrip& one = batch[n];
      one.plan = trip.plan;
      one.knots =
          make_knots(TripPath(network_, plan), trip, georeference_, options_.tolerance, one.error);
      const auto start = static_cast<float>(trip.start_time_s);
      one.trip.start_s = start < static_cast<float>(options_.cycle_s) ? start : 0.0f;
      one.trip.vehicle = static_cast<uint>(plan.type);
      one.trip.id = plan.id;
    });
    for (FittedTrip& one : batch) {
      if (one.knots.empty()) continue;
      report_.knot_error.position_m = std::max(report_.knot_error.position_m, one.error.position_m);
      report_.knot_error.heading_degrees =
          std::max(report_.knot_error.heading_degrees, one.error.heading_degrees);
      fitted_.push_back(std::move(one));
    }
    waiting_.clear();
  }

  const LinkNetwork& network_;
  std::span<const TripPlan> plans_;
  const Georeference& georeference_;
  const TrafficOptions& options_;
  TrafficReport& report_;
  std::vector<DrivenTrip> waiting_;
  std::vector<FittedTrip> fitted_;
};

void sum_up(TrafficSet& set) {
  TrafficReport& report = set.report;
  report.trips = set.trips.size();
  report.knots = set.knots.size();
  double seconds = 0;
  std::array<double, 24> seconds_by_hour{};
  for (const Trip& trip : set.trips) {
    const auto knots = std::span(set.knots).subspan(trip.first_knot, trip.knot_count);
    seconds += double{knots.back().time_s};
    for (std::size_t hour = 0; hour < 24; ++hour)
      if (set.cycle.density[hour] > trip.rank) seconds_by_hour[hour] += double{knots.back().time_s};
    bool braking = false;
    for (const TripKnot& knot : knots) {
      const bool now = (knot.pose & KNOT_BRAKING) != 0;
      if (now && !braking) ++report.brakings;
      braking = now;
    }
    for (std::size_t n = 1; n < knots.size(); ++n)
      report.driven_km +=
          glm::distance(glm::dvec3(knots[n - 1].position), glm::dvec3(knots[n].position)) / 1000;
    ++report.by_type[vehicle_types[trip.vehicle].name];
  }
  report.mean_vehicles = seconds / double{set.cycle.cycle_s};
  report.mean_speed_m_s = seconds > 0 ? report.driven_km * 1000 / seconds : 0;
  for (std::size_t hour = 0; hour < 24; ++hour)
    report.vehicles_by_hour[hour] = seconds_by_hour[hour] / double{set.cycle.cycle_s};
}

}  // namespace

TrafficSet make_traffic(const std::vector<osm::OsmWay>& highways,
                        const place::LonLatToFrame& to_frame, const place::HeightAt& height_at,
                        const place::InsideBuilding& inside, const TrafficOptions& options,
                        const Georeference& georeference, const StepProgress& progress,
                        const place::DeckAt& deck_at) {
  TrafficSet set;
  TrafficReport& report = set.report;
  report.tolerance = options.tolerance;
  report.cycle_s = options.cycle_s;
  Clock clock(report);
  const auto report_progress = [&](const char* step, double share) {
    if (progress) progress(step, share);
  };

  report_progress("streets", 0);
  const RoadGraph graph = make_road_graph(highways, to_frame, height_at, inside, options.side);
  report.left_out = graph.left_out;
  report.nodes = graph.nodes.size();
  report.edges = graph.edges.size();
  report.country = graph.country;
  report.side = graph.side;
  clock.lap("streets");

  report_progress("routes", 0);
  LinkNetwork network(graph, height_at, inside, deck_at);
  const Demand demand{busiest_vehicles(graph, options), options.cycle_s, options.seed,
                      static_cast<std::size_t>(options.max_trips)};
  const std::vector<TripPlan> plans = plan_trips(network, demand, report.plans);
  network.find_conflicts();
  report.links = network.links().size();
  for (const Link& link : network.links()) {
    report.links_km += link.curve.length() / 1000;
    if (link.in_buildings_m > 0) report.links_in_buildings_km += link.curve.length() / 1000;
  }
  clock.lap("routes");

  const auto max_share = *std::max_element(options.hours.begin(), options.hours.end());
  set.cycle.cycle_s = static_cast<float>(options.cycle_s);
  for (std::size_t hour = 0; hour < 24; ++hour)
    set.cycle.density[hour] =
        max_share > 0 ? std::clamp(options.hours[hour] / max_share, 0.0f, 1.0f) : 0.0f;

  TripMaker trips(network, plans, georeference, options, report);
  report.simulation = simulate(
      network, plans, options.cycle_s, [&](DrivenTrip&& trip) { trips.add(std::move(trip)); },
      [&](double share) { report_progress("driving", share); });
  trips.finish(set);
  rank_trips(set.trips);
  clock.lap("driving");
  if (set.trips.empty()) return set;

  VehicleLamps lamps = make_vehicle_lamps(graph.side, set.profiles);
  set.vehicles = std::move(lamps.kinds);
  set.vehicle_lights = std::move(lamps.lights);

  report_progress("overlaps", 0);
  const OverlapReport overlaps = find_overlaps(set.content(), overlap_step_s, overlap_slack_m);
  report.overlap_samples = overlaps.vehicle_samples;
  report.overlapping = overlaps.overlapping;
  report.overlaps_left_out = overlaps.left_out;
  if (overlaps.left_out > 0) {
    leave_out(set, overlaps.leave_out);
    rank_trips(set.trips);
  }
  clock.lap("overlaps");
  sum_up(set);
  return set;
}

}  // namespace nightcity::traffic
