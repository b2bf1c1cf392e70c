#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tools/traffic/link_network.h"
#include "tools/traffic/road_graph.h"
#include "tools/traffic/street_grid.h"
#include "tools/traffic/trip_plans.h"

namespace nightcity::traffic {
namespace {

using test::street;

const osm::OsmTags residential = {{"highway", "residential"}}, primary = {{"highway", "primary"}};

RoadGraph graph_of(const std::vector<osm::OsmWay>& ways,
                   const place::HeightAt& height = test::plane,
                   const place::InsideBuilding& inside = {}) {
  return make_road_graph(ways, test::to_plane, height, inside, Side::right);
}

const RoadEdge* edge_between(const RoadGraph& graph, const glm::dvec2& from, const glm::dvec2& to) {
  for (const RoadEdge& edge : graph.edges)
    if (glm::distance(edge.line.front(), from) < 0.5 && glm::distance(edge.line.back(), to) < 0.5)
      return &edge;
  return nullptr;
}

TEST(RoadGraph, OneWayStreetsHaveOneEdgeAndTheRightOne) {
  auto against = residential;
  against["oneway"] = "-1";
  const RoadGraph graph = graph_of(
      {street(1, {{0, 0}, {100, 0}}, residential), street(2, {{100, 0}, {200, 0}}, against)});
  EXPECT_TRUE(edge_between(graph, {0, 0}, {100, 0}));
  EXPECT_TRUE(edge_between(graph, {100, 0}, {0, 0}));
  EXPECT_TRUE(edge_between(graph, {200, 0}, {100, 0}));
  EXPECT_FALSE(edge_between(graph, {100, 0}, {200, 0}));
}

TEST(RoadGraph, LanesLieOnTheirSide) {
  const std::vector<osm::OsmWay> ways = {
      street(1, {{0, 0}, {100, 0}}, {{"highway", "primary"}, {"lanes", "4"}})};
  for (const Side side : {Side::right, Side::left}) {
    const RoadGraph graph = make_road_graph(ways, test::to_plane, test::plane, {}, side);
    LinkNetwork network(graph, test::plane);
    const place::HeightAt plane = test::plane;
    for (std::size_t e = 0; e < graph.edges.size(); ++e)
      for (int lane = 0; lane < 2; ++lane) {
        const RoadEdge& edge = graph.edges[e];
        const double to_right = edge.lane_offset(lane, side);
        EXPECT_GT(side == Side::right ? to_right : -to_right, 0);
        // The kerb lane is the outer one.
        EXPECT_NEAR(std::abs(to_right), edge.half_width_m - (lane + 0.5) * edge.lane_m, 1e-9);
        const auto& curve = network.links()[network.lane(e, lane)].curve;
        const glm::dvec2 along = glm::normalize(edge.line.back() - edge.line.front());
        const glm::dvec2 right(along.y, -along.x);
        EXPECT_NEAR(glm::dot(glm::dvec2(curve.at(30).point), right), to_right, 1e-6);
      }
  }
}

TEST(RoadGraph, LanesLieBesideParkedCars) {
  // 7.5 m wide, and cars park on the southernmost 2 m.
  const RoadGraph graph = graph_of(
      {street(1, {{0, 0}, {100, 0}}, {{"highway", "residential"}, {"parking:right", "lane"}})});
  ASSERT_EQ(graph.edges.size(), 2u);
  for (const RoadEdge& edge : graph.edges) {
    const bool east = edge.line.back().x > edge.line.front().x;
    const double to_right = edge.lane_offset(0, Side::right);
    EXPECT_NEAR(east ? -to_right : to_right, east ? -0.375 : 2.375, 1e-9) << "to the north";
  }
}

// A plane as maps have them: meridians draw together towards the pole, 69 degrees north.
glm::dvec2 to_cone(const glm::dvec2& lon_lat) {
  constexpr double metres_a_degree = 111'320, radian = 0.017453292519943295;
  const double from_pole = (90 - lon_lat.y) * metres_a_degree,
               angle = (std::remainder(lon_lat.x - 180, 360)) * radian;
  return {from_pole * std::sin(angle), 21 * metres_a_degree - from_pole * std::cos(angle)};
}

TEST(RoadGraph, LongWaysAreCutOnTheStraightLineOfThePlaneAlsoAcrossTheAntimeridian) {
  const place::HeightAt west = [](const glm::dvec2& p) -> std::optional<double> {
    return p.x < 3000 ? std::optional<double>(10) : std::nullopt;
  };
  // One way of 24 km, a part of which has ground.
  const glm::dvec2 a(179.7, 69), b(-179.7, 69.02);
  const RoadGraph graph = make_road_graph({{1, {a, b}, primary}}, to_cone, west, {}, Side::right);
  ASSERT_EQ(graph.edges.size(), 2u);
  const glm::dvec2 from = to_cone(a), along = glm::normalize(to_cone(b) - from);
  const glm::dvec2 end = graph.edges[0].line.back();
  EXPECT_NEAR(end.x, 3000, 0.1);
  EXPECT_NEAR(along.x * (end.y - from.y) - along.y * (end.x - from.x), 0, 1e-3)
      << "beside the line";
  EXPECT_TRUE(graph.nodes[graph.edges[0].to].border);
  EXPECT_NEAR(graph.nodes[graph.edges[0].to].height_m, 10, 1e-9);
}

TEST(RoadGraph, TheCountryIsThatOfMostNodesWhicheverWayComesFirst) {
  // Two streets of three near the border of Thailand's box, of which one is beyond it.
  const place::LonLatToFrame to_frame = [](const glm::dvec2& p) {
    return (p - glm::dvec2(100, 20.5)) * 1e5;
  };
  std::vector<osm::OsmWay> ways{{1, {{100, 20.51}, {100.01, 20.51}}, residential},
                                {2, {{100, 20.49}, {100.01, 20.49}}, residential},
                                {3, {{100, 20.48}, {100.01, 20.48}}, residential}};
  const place::HeightAt everywhere = [](const glm::dvec2&) { return std::optional(0.0); };
  for (int round = 0; round < 3; ++round) {
    EXPECT_EQ(make_road_graph(ways, to_frame, everywhere, {}).country, "Thailand") << round;
    std::rotate(ways.begin(), ways.begin() + 1, ways.end());
  }
}

TEST(RoadGraph, TheOrderAndTheIdsOfWaysDecideNothing) {
  std::vector<osm::OsmWay> ways{street(1, {{0, 0}, {100, 0}, {200, 0}}, residential),
                                street(2, {{100, 0}, {100, 100}}, residential),
                                street(3, {{100, -80}, {100, 0}}, primary)};
  const RoadGraph first = graph_of(ways);
  std::rotate(ways.begin(), ways.begin() + 1, ways.end());
  for (std::size_t n = 0; n < ways.size(); ++n) ways[n].id = static_cast<std::int64_t>(77 - n);
  const RoadGraph second = graph_of(ways);
  ASSERT_EQ(first.edges.size(), second.edges.size());
  for (std::size_t e = 0; e < first.edges.size(); ++e)
    EXPECT_EQ(first.edges[e].line, second.edges[e].line) << e;
}

TEST(RoadGraph, EndsWhereTheGroundEnds) {
  const place::HeightAt west = [](const glm::dvec2& p) -> std::optional<double> {
    return p.x < 333 ? std::optional<double>(10) : std::nullopt;
  };
  const RoadGraph graph = graph_of({street(1, {{0, 0}, {800, 0}}, residential)}, west);
  ASSERT_EQ(graph.edges.size(), 2u);
  double most = 0;
  for (const RoadNode& node : graph.nodes) most = std::max(most, node.place.x);
  EXPECT_NEAR(most, 333, 0.1);
  for (const RoadNode& node : graph.nodes) EXPECT_EQ(node.border, node.place.x > 300);
  EXPECT_EQ(graph_of({street(1, {{500, 0}, {800, 0}}, residential)}, west)
                .left_out.at("outside the model"),
            1u);
}

TEST(RoadGraph, RoadsThroughBuildingsAreLeftOutAndTunnelsAreNot) {
  const place::InsideBuilding house = [](const glm::dvec2& p) {
    return p.x > 40 && p.x < 50 && std::abs(p.y) < 8;
  };
  EXPECT_TRUE(
      graph_of({street(1, {{0, 0}, {100, 0}}, residential)}, test::plane, house).edges.empty());
  auto tunnel = residential;
  tunnel["tunnel"] = "yes";
  EXPECT_EQ(graph_of({street(1, {{0, 0}, {100, 0}}, tunnel)}, test::plane, house).edges.size(), 2u);
}

TEST(RoadGraph, BridgesGoEvenlyFromAbutmentToAbutment) {
  // A valley 20 m deep under two ways of one bridge.
  const place::HeightAt valley = [](const glm::dvec2& p) -> std::optional<double> {
    return p.x > 100 && p.x < 200 ? 30.0 : 50 + p.x / 100;
  };
  auto bridge = residential;
  bridge["bridge"] = "yes";
  bridge["layer"] = "1";
  const RoadGraph graph = graph_of(
      {street(1, {{0, 0}, {95, 0}}, residential), street(2, {{95, 0}, {130, 0}}, bridge),
       street(3, {{130, 0}, {205, 0}}, bridge), street(4, {{205, 0}, {300, 0}}, residential)},
      valley);
  LinkNetwork network(graph, valley);
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    if (!graph.edges[e].structure) continue;
    const Curve& curve = network.links()[network.lane(e, 0)].curve;
    for (double s = 0; s < curve.length(); s += 1) {
      const glm::dvec3 p = curve.at(s).point;
      EXPECT_NEAR(p.z, 50 + p.x / 100, 0.05) << "at " << p.x;
    }
  }
}

TEST(LinkNetwork, TurnsJoinTheirLanesSmoothly) {
  const auto ways = test::street_grid(3, 90, 60);
  const place::HeightAt hills = test::hills;
  const RoadGraph graph = graph_of(ways, hills);
  LinkNetwork network(graph, hills);
  std::size_t turns = 0;
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    for (const std::size_t next : graph.nodes[graph.edges[e].to].out) {
      if (next == graph.edges[e].opposite) continue;
      const Link& turn = network.links()[network.turn(e, 0, next, 0)];
      const Curve &from = network.links()[turn.from].curve, &to = network.links()[turn.to].curve;
      const auto a = from.at(from.length()), b = turn.curve.at(0),
                 c = turn.curve.at(turn.curve.length()), d = to.at(0);
      EXPECT_NEAR(glm::distance(a.point, b.point), 0, 1e-6);
      EXPECT_NEAR(glm::distance(c.point, d.point), 0, 1e-6);
      EXPECT_NEAR(glm::distance(a.along, b.along), 0, 1e-6);
      EXPECT_NEAR(glm::distance(c.along, d.along), 0, 1e-6);
      for (const Curve::Sample& sample : turn.curve.samples())
        EXPECT_LT(std::abs(sample.curvature), 0.5);
      ++turns;
    }
  EXPECT_GT(turns, 50u);
}

TEST(LinkNetwork, SpeedKeepsLimitsAndBends) {
  const place::HeightAt plane = test::plane;
  const RoadGraph graph = graph_of({street(1, {{0, 0}, {100, 0}, {100, 100}}, primary)});
  LinkNetwork network(graph, plane);
  const Link& link = network.links()[network.lane(0, 0)];
  for (std::size_t n = 0; n < link.allowed_m_s.size(); ++n) {
    const Curve::Sample& sample = link.curve.samples()[n];
    const double v = link.allowed_m_s[n];
    EXPECT_LE(v, graph.edges[0].speed_m_s + 1e-9);
    if (v > 1.6) {
      EXPECT_LE(v * v * std::abs(sample.curvature), sideways_acceleration * 1.001);
    }
    if (n > 0) {
      const double step = sample.s - link.curve.samples()[n - 1].s,
                   before = link.allowed_m_s[n - 1];
      EXPECT_LE(before * before - v * v, 2 * comfortable_braking * step * 1.001);
    }
  }
  EXPECT_NEAR(link.allowed_m_s.front(), graph.edges[0].speed_m_s, 1e-9);
}

/// Returns whether the first of two turns gives way to the second. Turns are given by where they
/// come from and go to, as unit vectors from the junction.
bool yields(const RoadGraph& graph, const glm::dvec2& from_a, const glm::dvec2& to_a,
            const glm::dvec2& from_b, const glm::dvec2& to_b) {
  const place::HeightAt plane = test::plane;
  LinkNetwork network(graph, plane);
  const auto edge = [&](const glm::dvec2& from, const glm::dvec2& to) {
    for (std::size_t e = 0; e < graph.edges.size(); ++e)
      if (glm::distance(graph.edges[e].line.front(), from) < 0.5 &&
          glm::distance(graph.edges[e].line.back(), to) < 0.5)
        return e;
    return none;
  };
  const auto turn = [&](const glm::dvec2& from, const glm::dvec2& to) {
    return network.turn(edge(from * 80.0, {0, 0}), 0, edge({0, 0}, to * 80.0), 0);
  };
  const std::size_t a = turn(from_a, to_a), b = turn(from_b, to_b);
  network.find_conflicts();
  for (const Conflict& conflict : network.links()[a].conflicts)
    if (conflict.other == b) return conflict.yields;
  ADD_FAILURE() << "no conflict";
  return false;
}

RoadGraph crossing(const osm::OsmTags& west_east, const osm::OsmTags& south_north) {
  return graph_of({street(1, {{-80, 0}, {0, 0}, {80, 0}}, west_east),
                   street(2, {{0, -80}, {0, 0}, {0, 80}}, south_north)});
}

constexpr glm::dvec2 west{-1, 0}, east{1, 0}, south{0, -1}, north{0, 1};

TEST(RightOfWay, MainRoadBeforeSideStreet) {
  const RoadGraph graph = crossing(primary, residential);
  EXPECT_FALSE(yields(graph, west, east, south, north));
  EXPECT_TRUE(yields(graph, south, north, west, east));
  EXPECT_TRUE(yields(graph, north, south, west, east));
}

TEST(RightOfWay, RightBeforeLeftBetweenEqualStreets) {
  const RoadGraph graph = crossing(residential, residential);
  // For a driver going east, traffic from the south comes from the right.
  EXPECT_TRUE(yields(graph, west, east, south, north));
  EXPECT_FALSE(yields(graph, south, north, west, east));
  EXPECT_FALSE(yields(graph, west, east, north, south));
}

TEST(RightOfWay, ATurnAcrossWaitsForOncomingTraffic) {
  const RoadGraph graph = crossing(primary, primary);
  EXPECT_TRUE(yields(graph, west, north, east, west));  // left turn
  EXPECT_FALSE(yields(graph, east, west, west, north));
}

TEST(RightOfWay, OppositeStraightsDoNotConflict) {
  const place::HeightAt plane = test::plane;
  const RoadGraph graph = crossing(primary, primary);
  LinkNetwork network(graph, plane);
  std::vector<std::size_t> straight;
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    for (const std::size_t next : graph.nodes[graph.edges[e].to].out)
      if (next != graph.edges[e].opposite && network.movement(e, next) == Movement::straight)
        straight.push_back(network.turn(e, 0, next, 0));
  network.find_conflicts();
  ASSERT_EQ(straight.size(), 4u);
  for (const std::size_t turn : straight) EXPECT_EQ(network.links()[turn].conflicts.size(), 2u);
}

TEST(LinkNetwork, NobodyTurnsRoundAnAcuteCornerInALoop) {
  // Two short wide streets that leave each other at 12 degrees: their lanes overlap where they
  // begin.
  const place::HeightAt plane = test::plane;
  const RoadGraph graph =
      graph_of({street(1, {{30, 0}, {0, 0}}, primary), street(2, {{0, 0}, {29, 6}}, primary),
                street(3, {{0, 0}, {-90, 0}}, primary)});
  LinkNetwork network(graph, plane);
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    for (const std::size_t next : graph.nodes[graph.edges[e].to].out) {
      if (next == graph.edges[e].opposite || !network.can_turn(e, 0, next, 0)) continue;
      const Curve::Sample &a = network.links()[network.lane(e, 0)].curve.samples().back(),
                          &b = network.links()[network.lane(next, 0)].curve.samples().front();
      const glm::dvec2 chord = glm::dvec2(b.point - a.point);
      EXPECT_GT(glm::dot(chord, glm::dvec2(a.along)), 0);
      EXPECT_GT(glm::dot(chord, glm::dvec2(b.along)), 0);
      EXPECT_NE(std::min(graph.edges[e].way_id, graph.edges[next].way_id) +
                    std::max(graph.edges[e].way_id, graph.edges[next].way_id),
                1 + 2)
          << "from one acute street into the other";
    }
}

TEST(Routes, ARoadTooLongForTheCycleIsSaidWithTheCycleThatWouldDo) {
  const RoadGraph graph = graph_of({street(1, {{0, 0}, {900, 0}}, primary)});
  LinkNetwork network(graph, test::plane, {});
  TripPlanReport report;
  Demand demand{20, 60, 1};
  EXPECT_TRUE(plan_trips(network, demand, report).empty());
  EXPECT_NEAR(report.too_long_km, 1.8, 0.01) << "both directions";
  TripPlanReport longer;
  demand.cycle_s = report.needed_cycle_s;
  EXPECT_FALSE(plan_trips(network, demand, longer).empty());
  EXPECT_EQ(longer.too_long_km, 0);
}

TEST(Routes, ARingWithoutEndsOrKerbsHasNoTripsAndIsCounted) {
  const osm::OsmTags trunk = {{"highway", "trunk"}};
  const RoadGraph graph =
      graph_of({street(1, {{0, 0}, {300, 0}}, trunk), street(2, {{300, 0}, {150, 300}}, trunk),
                street(3, {{150, 300}, {0, 0}}, trunk)});
  LinkNetwork network(graph, test::plane);
  TripPlanReport report;
  EXPECT_TRUE(plan_trips(network, {20, 300, 1}, report).empty());
  EXPECT_GT(report.lane_km.at("trunk"), 1.5);
  EXPECT_NEAR(report.wanted.at("trunk"), 20, 1e-9);
  EXPECT_EQ(report.given.at("trunk"), 0);
}

TEST(Routes, PlansEndAtTheirLimitAndSayWhatIsLeftOut) {
  // A trip along the whole street takes a hundredth of a second: it takes millions of them to keep
  // a thousand vehicles on it.
  const RoadGraph graph = graph_of({street(1, {{0, 0}, {0.1, 0}}, primary)});
  LinkNetwork network(graph, test::plane, {});
  TripPlanReport report;
  Demand demand{1000, 600, 1, 50};
  EXPECT_EQ(plan_trips(network, demand, report).size(), 50u);
  EXPECT_GT(report.beyond_limit, 990u);
  EXPECT_LE(report.beyond_limit, 1000u);
  TripPlanReport more;
  demand.max_trips = 80;
  EXPECT_EQ(plan_trips(network, demand, more).size(), 80u);
}

TEST(Routes, NobodyIsSentThroughAWall) {
  // The corner of a house stands on the kerb lane of the main road's eastern half.
  const place::InsideBuilding house = [](const glm::dvec2& p) {
    return p.x > 40 && p.x < 50 && p.y < -1.5 && p.y > -9;
  };
  const place::HeightAt plane = test::plane;
  const RoadGraph graph = graph_of({street(1, {{-300, 0}, {0, 0}, {300, 0}}, primary),
                                    street(2, {{0, -300}, {0, 0}, {0, 300}}, primary)});
  LinkNetwork network(graph, plane, house);
  TripPlanReport report;
  const auto plans = plan_trips(network, {20, 300, 5}, report);
  ASSERT_GT(plans.size(), 20u);
  EXPECT_GT(report.through_buildings, 0u);
  std::size_t westward = 0;
  for (const TripPlan& plan : plans)
    for (const std::size_t number : plan.links) {
      const Link& link = network.links()[number];
      EXPECT_EQ(link.in_buildings_m, 0);
      for (const Curve::Sample& sample : link.curve.samples()) {
        EXPECT_FALSE(house(glm::dvec2(sample.point)));
        westward += sample.point.x > 60;
      }
    }
  EXPECT_GT(westward, 0u) << "the other side of that street is free";
}

}  // namespace
}  // namespace nightcity::traffic
