#include "tools/traffic/traffic.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "formats/traffic_pose.h"
#include "tools/random.h"
#include "tools/traffic/lamps.h"
#include "tools/traffic/link_network.h"

namespace nightcity::traffic {
namespace {

constexpr double overlap_step_s = 0.5, overlap_slack_m = 0.08;

class Clock {
 public:
  explicit Clock(TrafficReport& report) : report_(report) {}
  void lap(const char* step) {
    const auto now = std::chrono::steady_clock::now();
    report_.seconds.emplace_back(step, std::chrono::duration<double>(now - start_).count());
    start_ = now;
  }

 private:
  TrafficReport& report_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Vehicles at once with every trip on the road: the table is for 22:00, the busiest hour has more.
double busiest_vehicles(const RoadGraph& graph, const TrafficOptions& options) {
  const auto most = double{*std::max_element(options.hours.begin(), options.hours.end())};
  const auto at_table_hour = double{options.hours[(table_hour + 12) % 24]};
  double wanted = vehicles_by_table(graph);
  if (options.per_km) wanted = *options.per_km * graph.lane_km();
  if (options.vehicles) wanted = *options.vehicles;
  return at_table_hour > 0 ? wanted * most / at_table_hour : wanted;
}

/// Trips in the order of their routes, whatever order they ended in.
struct PendingTrip {
  std::size_t route;
  Trip trip;
  std::vector<TripKnot> knots;
  double driven_m;
};

void keep(TrafficSet& set, const std::vector<PendingTrip>& pending, const std::vector<bool>& drop) {
  set.trips.clear();
  set.knots.clear();
  // Ranks spread evenly: any hour's share is that share, not a draw of lots. The order is by identity, so a
  // trip keeps about its rank when others go.
  std::vector<std::size_t> order;
  for (std::size_t n = 0; n < pending.size(); ++n)
    if (drop.empty() || !drop[n]) order.push_back(n);
  std::vector<std::size_t> by_lot = order;
  std::stable_sort(by_lot.begin(), by_lot.end(), [&](std::size_t a, std::size_t b) {
    return mix(pending[a].trip.id) < mix(pending[b].trip.id);
  });
  std::vector<float> rank(pending.size(), 0);
  for (std::size_t k = 0; k < by_lot.size(); ++k)
    rank[by_lot[k]] = std::min(
        static_cast<float>((static_cast<double>(k) + 0.5) / static_cast<double>(by_lot.size())), 0.99999994f);
  for (const std::size_t n : order) {
    Trip trip = pending[n].trip;
    trip.rank = rank[n];
    trip.first_knot = static_cast<uint>(set.knots.size());
    trip.knot_count = static_cast<uint>(pending[n].knots.size());
    set.knots.insert(set.knots.end(), pending[n].knots.begin(), pending[n].knots.end());
    set.trips.push_back(trip);
  }
}

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

TrafficSet make_traffic(const std::vector<OsmWay>& highways, const LonLatToFrame& to_frame,
                        const HeightAt& height_at, const InsideBuilding& inside,
                        const TrafficOptions& options, const Georeference& georeference,
                        const StepProgress& progress) {
  TrafficSet set;
  TrafficReport& report = set.report;
  report.tolerance = options.tolerance;
  report.cycle_s = options.cycle_s;
  Clock clock(report);
  const auto tell = [&](const char* step, double share) {
    if (progress) progress(step, share);
  };

  tell("streets", 0);
  const RoadGraph graph = make_road_graph(highways, to_frame, height_at, inside, options.side);
  report.left_out = graph.left_out;
  report.nodes = graph.nodes.size();
  report.edges = graph.edges.size();
  report.country = graph.country;
  report.side = graph.side;
  clock.lap("streets");

  tell("routes", 0);
  LinkNetwork network(graph, height_at);
  const Demand demand{busiest_vehicles(graph, options), options.cycle_s, options.seed};
  const std::vector<Route> routes = make_routes(network, demand, report.routes);
  network.find_conflicts();
  report.links = network.links().size();
  clock.lap("routes");

  const auto most = *std::max_element(options.hours.begin(), options.hours.end());
  set.cycle.cycle_s = static_cast<float>(options.cycle_s);
  for (std::size_t hour = 0; hour < 24; ++hour)
    set.cycle.density[hour] = most > 0 ? std::clamp(options.hours[hour] / most, 0.0f, 1.0f) : 0.0f;

  std::vector<PendingTrip> pending;
  const auto sink = [&](Drive&& drive) {
    const Route& route = routes[drive.route];
    const RoutePath path(network, route);
    PendingTrip one{
        drive.route, {}, make_knots(path, drive, georeference, options.tolerance, report.knot_error), 0};
    if (one.knots.empty()) return;
    const auto start = static_cast<float>(drive.start_time_s);
    one.trip.start_s = start < set.cycle.cycle_s ? start : 0.0f;
    one.trip.vehicle = static_cast<uint>(route.type);
    one.trip.id = route.id;
    pending.push_back(std::move(one));
  };
  report.simulation =
      simulate(network, routes, options.cycle_s, sink, [&](double share) { tell("driving", share); });
  std::stable_sort(pending.begin(), pending.end(),
                   [](const PendingTrip& a, const PendingTrip& b) { return a.route < b.route; });
  clock.lap("driving");
  if (pending.empty()) return set;

  VehicleLamps lamps = make_vehicle_lamps(graph.side, set.profiles);
  set.vehicles = std::move(lamps.kinds);
  set.vehicle_lights = std::move(lamps.lights);

  tell("overlaps", 0);
  keep(set, pending, {});
  const OverlapReport overlaps = find_overlaps(set.content(), overlap_step_s, overlap_slack_m);
  report.overlap_samples = overlaps.vehicle_samples;
  report.overlapping = overlaps.overlapping;
  report.overlap_dropped = overlaps.dropped;
  if (overlaps.dropped > 0) keep(set, pending, overlaps.drop);
  clock.lap("overlaps");
  sum_up(set);
  return set;
}

}  // namespace nightcity::traffic
