#include "tools/traffic/trip_plans.h"

#include <algorithm>
#include <cmath>

#include "tools/random.h"

namespace nightcity::traffic {
namespace {

constexpr double hindered = 0.7;  // mean speed over limit in a town, because of bends and junctions
// From a junction to where a vehicle pulls out, so that others have room to brake.
constexpr double parking_margin_m = 28;
constexpr double stop_margin_m = 8;        // from where a vehicle parks to the next junction
constexpr std::size_t links_a_trip = 200;  // on average, at most; a real one passes some 40
constexpr double longest_trip = 0.7;       // share of the cycle
constexpr double kerb_gap_m = 0.25;
constexpr double tightest_m = 2.2, tightest_large_m = 5;  // radii of turns that vehicles can steer

/// Draws an index with a probability proportional to its weight, in logarithmic time.
class WeightedChoice {
 public:
  void add(double weight) { sums_.push_back((sums_.empty() ? 0 : sums_.back()) + weight); }
  double total() const { return sums_.empty() ? 0 : sums_.back(); }
  std::size_t pick(Random& random) const {
    const double at = random.uniform() * total();
    const auto found = std::upper_bound(sums_.begin(), sums_.end() - 1, at);
    return static_cast<std::size_t>(found - sums_.begin());
  }

 private:
  std::vector<double> sums_;
};

class TripPlanner {
 public:
  TripPlanner(LinkNetwork& network, const Demand& demand, TripPlanReport& report)
      : network_(network), graph_(network.graph()), demand_(demand), report_(report) {
    for (const RoadEdge& edge : graph_.edges) {
      const double amount = edge.traffic->density_per_km_lane * edge.length_m * edge.lanes;
      Tally& tally = tallies_[edge.traffic];
      tally.wanted += amount;
      wanted_ += amount;
      report_.lane_km[edge.road->highway] += edge.length_m * edge.lanes / 1000;
      count_if_too_long(edge);
    }
    for (std::size_t e = 0; e < graph_.edges.size(); ++e) {
      const RoadEdge& edge = graph_.edges[e];
      const RoadNode& from = graph_.nodes[edge.from];
      if (from.streets == 1) {
        gates_.push_back(e);
        gate_choice_.add(flow(edge) * (from.border ? 1 : 0.3));
      }
      if (may_park(e)) {
        kerbs_.push_back(e);
        kerb_choice_.add(edge.length_m * edge.traffic->density_per_km_lane);
      }
    }
    // Besides the trips that come over the border, as many start inside the map as keep up the
    // number of vehicles.
    const double starts_per_s = demand.vehicles / mean_trip_s();
    const double incoming = gate_choice_.total() * demand.vehicles / std::max(wanted_, 1e-9);
    gate_share_ = kerbs_.empty()   ? 1
                  : gates_.empty() ? 0
                                   : std::clamp(incoming / std::max(starts_per_s, 1e-9), 0.1, 0.8);
  }

  std::vector<TripPlan> make() {
    std::vector<TripPlan> plans;
    const bool has_ends = !gates_.empty() || !kerbs_.empty();
    if (wanted_ > 0 && has_ends) plans = plan_trips();
    for (const auto& [road, tally] : tallies_) {
      report_.wanted[road->highway] = wanted_ > 0 ? demand_.vehicles * tally.wanted / wanted_ : 0;
      report_.given[road->highway] = tally.given / demand_.cycle_s;
    }
    return plans;
  }

 private:
  struct Tally {
    double wanted = 0, given = 0;
  };

  std::vector<TripPlan> plan_trips() {
    std::vector<TripPlan> plans;
    const double budget = demand_.vehicles * demand_.cycle_s;
    double spent = 0;
    std::size_t failures = 0, links = 0;
    const std::size_t max_links = links_a_trip * demand_.max_trips;
    for (std::uint32_t number = 0; spent < budget && failures < 1000; ++number) {
      if (plans.size() >= demand_.max_trips || links > max_links) {
        report_.beyond_limit =
            static_cast<std::size_t>(std::ceil((budget - spent) / demand_.cycle_s));
        break;
      }
      Random random{static_cast<std::int64_t>(demand_.seed), 71, number};
      auto plan = try_one(random);
      if (!plan) {
        ++report_.left_out;
        ++failures;
        continue;
      }
      failures = 0;
      plan->id = static_cast<std::uint32_t>(mix(demand_.seed * 1000003 + number));
      spent += plan->free_time_s;
      links += plan->links.size();
      plans.push_back(std::move(*plan));
    }
    return plans;
  }

  double mean_trip_s() const { return std::min(150.0, 0.35 * demand_.cycle_s); }
  double longest_trip_s() const { return longest_trip * demand_.cycle_s; }

  void count_if_too_long(const RoadEdge& edge) {
    const double time = time_on(edge, edge.length_m);
    if (time <= longest_trip_s()) return;
    report_.too_long_km += edge.length_m / 1000;
    constexpr double slowest = 0.74;  // the smallest speed factor of vehicle_types
    report_.needed_cycle_s = std::max(report_.needed_cycle_s, time / slowest / longest_trip);
  }

  static double flow(const RoadEdge& edge) {
    return edge.traffic->density_per_km_lane * 1e-3 * edge.lanes * edge.speed_m_s;
  }

  static double time_on(const RoadEdge& edge, double length) {
    return length / (edge.speed_m_s * hindered);
  }

  bool may_park(std::size_t e) const {
    const RoadEdge& edge = graph_.edges[e];
    return edge.traffic->parking && !edge.structure && !edge.roundabout &&
           network_.lane_length(e) > parking_margin_m + stop_margin_m + 5;
  }

  /// Returns a factor above 1 for a class of road that has had less than its share of the
  /// traffic so far.
  double lack(const RoadEdge& edge) const {
    const Tally& tally = tallies_.at(edge.traffic);
    const double share = tally.wanted / wanted_, have = given_ > 0 ? tally.given / given_ : share;
    const double ratio = (share + 0.002) / (have + 0.002);
    return std::clamp(ratio * ratio, 0.05, 20.0);
  }

  std::size_t pick_type(const RoadEdge& edge, Random& random) const {
    double at = random.uniform();
    for (std::size_t k = 0; k < vehicle_type_count; ++k) {
      at -= vehicle_types[k].share;
      if (at < 0) return vehicle_types[k].large && !edge.traffic->large_vehicles ? 0 : k;
    }
    return 0;
  }

  std::size_t next_edge(std::size_t edge, bool large, Random& random) const {
    const RoadNode& node = graph_.nodes[graph_.edges[edge].to];
    WeightedChoice choice;
    std::vector<std::size_t> options;
    for (const std::size_t e : node.out) {
      const RoadEdge& out = graph_.edges[e];
      if (e == graph_.edges[edge].opposite || (large && !out.traffic->large_vehicles)) continue;
      if (network_.turn_radius(edge, e) < (large ? tightest_large_m : tightest_m)) continue;
      options.push_back(e);
      choice.add(flow(out) * lack(out) *
                 (network_.movement(edge, e) == Movement::straight ? 2.5 : 1));
    }
    return options.empty() || !(choice.total() > 0) ? none : options[choice.pick(random)];
  }

  std::optional<TripPlan> try_one(Random& random) {
    TripPlan plan;
    plan.from_kerb = random.uniform() >= gate_share_;
    std::vector<std::size_t> edges = {plan.from_kerb ? kerbs_[kerb_choice_.pick(random)]
                                                     : gates_[gate_choice_.pick(random)]};
    plan.type = pick_type(graph_.edges[edges[0]], random);
    const VehicleType& type = vehicle_types[plan.type];
    if (plan.from_kerb && type.large) return std::nullopt;
    plan.speed_factor = random.range(type.speed_factor[0], type.speed_factor[1]);
    plan.start_time_s = random.uniform() * demand_.cycle_s;
    const double enough = mean_trip_s() * random.range(0.5, 1.5);
    bool to_kerb = false;
    for (;;) {
      const RoadEdge& edge = graph_.edges[edges.back()];
      plan.free_time_s += time_on(edge, edge.length_m) / plan.speed_factor;
      if (plan.free_time_s > longest_trip_s()) return std::nullopt;
      if (plan.free_time_s > enough && edges.size() > 1 && !type.large && may_park(edges.back())) {
        to_kerb = true;
        break;
      }
      const std::size_t next = next_edge(edges.back(), type.large, random);
      if (next == none) break;
      edges.push_back(next);
    }
    // A trip may end without parking only where a street really ends.
    const RoadNode& last = graph_.nodes[graph_.edges[edges.back()].to];
    if (!to_kerb && last.streets != 1) return std::nullopt;
    if (!to_kerb && edges.size() == 1 && plan.from_kerb) return std::nullopt;
    plan.to_stop = to_kerb || !last.border;
    if (!choose_lanes(plan, edges, to_kerb, random)) return std::nullopt;
    for (const std::size_t e : edges) {
      const double time = time_on(graph_.edges[e], graph_.edges[e].length_m) / plan.speed_factor;
      tallies_[graph_.edges[e].traffic].given += time;
      given_ += time;
    }
    return plan;
  }

  /// Chooses the lanes, from the end backwards: the next turn decides, and a vehicle that goes
  /// straight on keeps its lane, so that lanes change only in turns. Returns false where only a
  /// loop leads from one lane to the next, where a bend is too tight, and where a wall stands
  /// in the way.
  bool choose_lanes(TripPlan& plan, const std::vector<std::size_t>& edges, bool to_kerb,
                    Random& random) {
    std::vector<int> lanes(edges.size());
    const bool right_hand = graph_.side == Side::right;
    for (std::size_t n = edges.size(); n-- > 0;) {
      const int count = graph_.edges[edges[n]].lanes;
      if (n + 1 == edges.size()) {
        lanes[n] = to_kerb ? 0 : random.integer(0, count - 1);
        continue;
      }
      const Movement movement = network_.movement(edges[n], edges[n + 1]);
      if (movement == Movement::straight)
        lanes[n] = std::min(lanes[n + 1], count - 1);
      else
        lanes[n] = (movement == Movement::right) == right_hand ? 0 : count - 1;
    }
    for (std::size_t n = 1; n < edges.size(); ++n)
      if (!network_.can_turn(edges[n - 1], lanes[n - 1], edges[n], lanes[n])) return false;
    for (std::size_t n = 0; n < edges.size(); ++n) {
      if (n > 0)
        plan.links.push_back(network_.turn(edges[n - 1], lanes[n - 1], edges[n], lanes[n]));
      plan.links.push_back(network_.lane(edges[n], lanes[n]));
    }
    for (const std::size_t number : plan.links) {
      const Link& link = network_.links()[number];
      if (link.in_buildings_m > 0) ++report_.through_buildings;
      if (link.in_buildings_m > 0 || !link.steerable) return false;
    }
    const VehicleType& type = vehicle_types[plan.type];
    const double half = type.length_m / 2;
    const auto aside = [&](const RoadEdge& edge, int lane) {
      if (lane != 0) return 0.0;
      const double room = edge.lane_m / 2 - type.width_m / 2 - kerb_gap_m;
      return (right_hand ? 1 : -1) * std::max(0.0, room);
    };
    const double first = network_.links()[plan.links.front()].curve.length();
    const double last = network_.links()[plan.links.back()].curve.length();
    plan.start_s = std::min(half, first / 2);
    if (plan.from_kerb) {
      plan.start_s = random.range(std::min(parking_margin_m, first / 2),
                                  std::max(first - stop_margin_m, first / 2));
      plan.start_aside_m = aside(graph_.edges[edges.front()], lanes.front());
    }
    plan.end_s = std::max(last - half, last / 2);
    if (to_kerb) {
      plan.end_s = random.range(std::min(15.0, last / 2), std::max(last - stop_margin_m, last / 2));
      plan.end_aside_m = aside(graph_.edges[edges.back()], lanes.back());
    }
    return true;
  }

  LinkNetwork& network_;
  const RoadGraph& graph_;
  const Demand& demand_;
  TripPlanReport& report_;
  std::map<const TrafficClass*, Tally> tallies_;
  double wanted_ = 0, given_ = 0, gate_share_ = 0;
  std::vector<std::size_t> gates_, kerbs_;
  WeightedChoice gate_choice_, kerb_choice_;
};

}  // namespace

double vehicles_by_table(const RoadGraph& graph) {
  double sum = 0;
  for (const RoadEdge& edge : graph.edges)
    sum += edge.traffic->density_per_km_lane * edge.length_m / 1000 * edge.lanes;
  return sum;
}

std::vector<TripPlan> plan_trips(LinkNetwork& network, const Demand& demand,
                                 TripPlanReport& report) {
  return TripPlanner(network, demand, report).make();
}

}  // namespace nightcity::traffic
