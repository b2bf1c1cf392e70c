#include "tools/traffic/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "tools/traffic/driver_model.h"
#include "tools/traffic/street_grid.h"

namespace nightcity::traffic {
namespace {

using test::street;

/// A network, planned trips through it and how they were driven.
class Town {
 public:
  explicit Town(const std::vector<osm::OsmWay>& ways)
      : graph(make_road_graph(ways, test::to_plane, height, {}, Side::right)),
        network(graph, height) {}

  std::size_t edge(const glm::dvec2& from, const glm::dvec2& to) const {
    for (std::size_t e = 0; e < graph.edges.size(); ++e)
      if (glm::distance(graph.edges[e].line.front(), from) < 0.5 &&
          glm::distance(graph.edges[e].line.back(), to) < 0.5)
        return e;
    return none;
  }

  TripPlan& add(const std::vector<std::size_t>& edges, double start_time_s) {
    TripPlan plan;
    for (std::size_t n = 0; n < edges.size(); ++n) {
      if (n > 0) plan.links.push_back(network.turn(edges[n - 1], 0, edges[n], 0));
      plan.links.push_back(network.lane(edges[n], 0));
    }
    plan.start_s = 3;
    plan.end_s = network.links()[plan.links.back()].curve.length() - 3;
    plan.start_time_s = start_time_s;
    plan.id = static_cast<std::uint32_t>(plans.size());
    plans.push_back(plan);
    return plans.back();
  }

  void run(double cycle_s) {
    network.find_conflicts();
    report =
        simulate(network, plans, cycle_s, [&](DrivenTrip&& trip) { driven[trip.plan] = trip; });
  }

  const place::HeightAt height = test::plane;
  RoadGraph graph;
  LinkNetwork network;
  std::vector<TripPlan> plans;
  std::map<std::size_t, DrivenTrip> driven;
  SimulationReport report;
};

double duration(const DrivenTrip& trip) {
  return static_cast<double>(trip.speed_m_s.size() - 1) * step_s;
}

TEST(Simulation, AVehicleAloneOnTheRoadDrivesAtTheLimit) {
  Town town({street(1, {{0, 0}, {500, 0}}, {{"highway", "primary"}})});
  town.add({town.edge({0, 0}, {500, 0})}, 10);
  town.run(200);
  ASSERT_EQ(town.driven.size(), 1u);
  EXPECT_NEAR(duration(town.driven[0]), 494 / (50 / 3.6), 0.5);
  EXPECT_NEAR(town.driven[0].start_time_s, 10, step_s);
  for (const float v : town.driven[0].speed_m_s) EXPECT_NEAR(v, 50 / 3.6, 0.01);
}

TEST(Simulation, AFollowerKeepsTheEquilibriumGapOfTheModel) {
  Town town({street(1, {{0, 0}, {900, 0}}, {{"highway", "primary"}})});
  const std::size_t e = town.edge({0, 0}, {900, 0});
  town.add({e}, 10).speed_factor = 0.5;
  town.add({e}, 14);
  town.run(400);
  ASSERT_EQ(town.driven.size(), 2u);
  const DrivenTrip &first = town.driven[0], &second = town.driven[1];
  const auto lag =
      static_cast<std::size_t>(std::lround((second.start_time_s - first.start_time_s) / step_s));
  const double length = vehicle_types[0].length_m, v = 0.5 * 50 / 3.6;
  double least = 1e9;
  for (std::size_t n = 0; n < second.distance_m.size() && n + lag < first.distance_m.size(); ++n)
    least =
        std::min(least, double{first.distance_m[n + lag]} - double{second.distance_m[n]} - length);
  EXPECT_GT(least, standstill_gap_m);
  // Treiber's equilibrium: s_e(v) = (s0 + v T) / sqrt(1 - (v / v0)^4), as far as it is reached on
  // 900 m of road.
  const std::size_t late = second.distance_m.size() - 60;
  const double gap =
      double{first.distance_m[late + lag]} - double{second.distance_m[late]} - length;
  EXPECT_NEAR(gap, (standstill_gap_m + v * headway_s) / std::sqrt(1 - std::pow(0.5, 4)), 1.0);
  EXPECT_NEAR(second.speed_m_s[late], v, 0.3);
}

TEST(Simulation, NobodyExceedsTheirShareOfTheLimitOrBrakesHarderThanPossible) {
  Town town(test::street_grid(3, 90, 60));
  Demand demand{25, 240, 7};
  TripPlanReport plans;
  town.plans = plan_trips(town.network, demand, plans);
  town.run(demand.cycle_s);
  EXPECT_GT(town.driven.size(), 30u);
  for (const auto& [number, trip] : town.driven) {
    const TripPlan& plan = town.plans[number];
    double limit = 0;
    for (const std::size_t link : plan.links)
      limit = std::max(limit, town.graph.edges[town.network.links()[link].edge].speed_m_s);
    for (std::size_t n = 0; n < trip.speed_m_s.size(); ++n) {
      EXPECT_LE(trip.speed_m_s[n], limit * plan.speed_factor + 0.05);
      if (n == 0) continue;
      EXPECT_GE(trip.speed_m_s[n] - trip.speed_m_s[n - 1], -hardest_braking * step_s - 1e-3);
      EXPECT_GE(trip.distance_m[n], trip.distance_m[n - 1]);
    }
  }
}

TEST(Simulation, TheSideStreetWaitsAndTheMainRoadDoesNot) {
  Town town({street(1, {{-200, 0}, {0, 0}, {200, 0}}, {{"highway", "primary"}}),
             street(2, {{0, -200}, {0, 0}, {0, 200}}, {{"highway", "residential"}})});
  // Both would reach the crossing at the same time.
  town.add({town.edge({-200, 0}, {0, 0}), town.edge({0, 0}, {200, 0})}, 20);
  town.add({town.edge({0, -200}, {0, 0}), town.edge({0, 0}, {0, 200})}, 20);
  town.run(120);
  ASSERT_EQ(town.driven.size(), 2u);
  EXPECT_NEAR(duration(town.driven[0]), 394 / (50 / 3.6), 1.0);
  EXPECT_GT(duration(town.driven[1]), duration(town.driven[0]) + 2);
}

TEST(Simulation, AVehicleStopsWhereItsTripEndsParked) {
  Town town({street(1, {{0, 0}, {300, 0}}, {{"highway", "residential"}})});
  TripPlan& plan = town.add({town.edge({0, 0}, {300, 0})}, 5);
  plan.from_kerb = plan.to_stop = true;
  plan.start_s = 40;
  plan.end_s = 220;
  town.run(120);
  ASSERT_EQ(town.driven.size(), 1u);
  const DrivenTrip& trip = town.driven[0];
  EXPECT_EQ(trip.speed_m_s.front(), 0);
  EXPECT_LT(trip.speed_m_s.back(), 0.35);
  EXPECT_NEAR(trip.distance_m.front(), 40, 1e-3);
  EXPECT_NEAR(trip.distance_m.back(), 220, 0.7);
}

TEST(Simulation, IsTheSameEveryTime) {
  const auto once = [] {
    Town town(test::street_grid(2, 90, 60));
    TripPlanReport report;
    town.plans = plan_trips(town.network, {15, 180, 3}, report);
    town.run(180);
    return town.driven;
  };
  const auto a = once(), b = once();
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [number, trip] : a) {
    EXPECT_EQ(trip.distance_m, b.at(number).distance_m);
    EXPECT_EQ(trip.start_time_s, b.at(number).start_time_s);
  }
}

TEST(Simulation, DemandThatNoStreetTakesDoesNotLengthenTheSteps) {
  // A thousand trips are due on a street that lets a few vehicles in, on one lane.
  Town town({street(1, {{0, 0}, {20, 0}}, {{"highway", "residential"}})});
  const std::size_t e = town.edge({0, 0}, {20, 0});
  for (int n = 0; n < 1000; ++n) town.add({e}, 0.02 * n);
  town.run(60);
  const SimulationReport& report = town.report;
  EXPECT_GT(report.driven, 5u);
  EXPECT_EQ(report.driven + report.never_started + report.stuck, 1000u) << "each trip is counted";
  EXPECT_LE(report.stuck, 16u) << "one that never started is not stuck";
  // Each second, 16 trips look, and each trip does once when its turn comes.
  EXPECT_LE(report.looks, 16 * (report.steps / 4 + 1) + 3 * 1000);
}

TEST(Simulation, TripsThatQueueStartInTheOrderInWhichTheyAreDue) {
  Town town({street(1, {{0, 0}, {300, 0}}, {{"highway", "residential"}})});
  const std::size_t e = town.edge({0, 0}, {300, 0});
  for (int n = 0; n < 100; ++n) town.add({e}, 0.01 * n);
  town.run(600);
  ASSERT_EQ(town.report.driven, 100u) << "all of them find room within the cycle";
  std::vector<double> starts;
  for (const auto& [plan, trip] : town.driven) starts.push_back(trip.start_time_s);
  // Sixteen look for room at a time; those that were to start first go first.
  for (std::size_t n = 40; n < starts.size(); ++n) EXPECT_GT(starts[n], starts[n - 40]);
}

}  // namespace
}  // namespace nightcity::traffic
