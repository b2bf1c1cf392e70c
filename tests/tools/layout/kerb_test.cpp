// Lamps and traffic take the kerb from one place: no post stands where vehicles drive.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>

#include "tools/layout/layout.h"
#include "tools/layout/street_plane.h"
#include "tools/line.h"
#include "tools/roads/carriageway.h"
#include "tools/traffic/link_network.h"
#include "tools/traffic/vehicle_types.h"

namespace nightcity::layout {
namespace {

using test::street;

lights::LampSet posts_of(const std::vector<osm::OsmWay>& ways) {
  osm::OsmData osm;
  osm.highways = ways;
  lights::LampSet set;
  lay_out_lamps(osm, test::to_plane, test::plane, {}, {}, {}, set);
  std::erase_if(set.lamps, [](const lights::PlacedLamp& lamp) { return lamp.hung; });
  return set;
}

traffic::RoadGraph graph_of(const std::vector<osm::OsmWay>& ways) {
  return traffic::make_road_graph(ways, test::to_plane, test::plane, {}, traffic::Side::right);
}

TEST(Kerb, PostsStandBehindTheKerbThatVehiclesKeepToOnEveryClassOfRoad) {
  std::size_t posts = 0, edges = 0;
  for (const roads::RoadClass& road : roads::road_classes())
    for (const char* oneway : {"", "yes", "no", "-1"})
      for (const osm::OsmTags& more :
           {osm::OsmTags{}, osm::OsmTags{{"lanes", "1"}}, osm::OsmTags{{"lanes", "3"}},
            osm::OsmTags{{"lanes", "4"}}, osm::OsmTags{{"width", "2.5"}},
            osm::OsmTags{{"width", "7"}}, osm::OsmTags{{"width", "14"}},
            osm::OsmTags{{"width", "24"}, {"lanes", "2"}}, osm::OsmTags{{"parking:right", "lane"}},
            osm::OsmTags{{"parking:lane:both", "parallel"}, {"width", "5"}}}) {
        osm::OsmTags tags = more;
        tags["highway"] = road.highway;
        tags["lit"] = "yes";
        if (*oneway) tags["oneway"] = oneway;
        const std::vector<osm::OsmWay> ways = {street(1, {{-150, 0}, {150, 0}}, tags)};
        const double kerb = roads::carriageway_width(tags) / 2;
        const lights::LampSet set = posts_of(ways);
        for (const lights::PlacedLamp& lamp : set.lamps)
          EXPECT_GT(std::abs(lamp.foot.y), kerb) << road.highway << " " << oneway;
        posts += set.lamps.size();
        for (const traffic::RoadEdge& edge : graph_of(ways).edges) {
          ++edges;
          for (int lane = 0; lane < edge.lanes; ++lane)
            EXPECT_LE(std::abs(edge.lane_offset(lane, traffic::Side::right)) + edge.lane_m / 2,
                      kerb + 1e-9)
                << road.highway << " " << oneway;
        }
      }
  EXPECT_GT(posts, 5000u);
  EXPECT_GT(edges, 500u);
}

TEST(Kerb, NoPostStandsWhereAVehicleDrivesInATownWithEveryClass) {
  std::vector<osm::OsmWay> ways;
  const char* const along[] = {"primary", "secondary", "tertiary", "residential", "service"};
  const char* const across[] = {"trunk", "primary", "unclassified", "living_street", "residential"};
  constexpr double block_m = 120;
  const auto line = [&](int n, bool east) {
    std::vector<glm::dvec2> points;
    for (int k = -1; k <= 5; ++k)
      points.push_back(east ? glm::dvec2(k * block_m, n * block_m)
                            : glm::dvec2(n * block_m, k * block_m));
    return points;
  };
  for (int n = 0; n < 5; ++n) {
    ways.push_back(street(1 + n, line(n, true), {{"highway", along[n]}, {"lit", "yes"}}));
    ways.push_back(street(11 + n, line(n, false),
                          {{"highway", across[n]},
                           {"lit", "yes"},
                           {n % 2 ? "oneway" : "name", "yes"},
                           {n == 1 ? "lanes" : "note", "3"}}));
  }
  const lights::LampSet set = posts_of(ways);
  ASSERT_GT(set.lamps.size(), 100u);

  const traffic::RoadGraph graph = graph_of(ways);
  traffic::LinkNetwork network(graph, test::plane);
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    for (int lane = 0; lane < graph.edges[e].lanes; ++lane) {
      network.lane(e, lane);
      for (const std::size_t next : graph.nodes[graph.edges[e].to].out)
        if (next != graph.edges[e].opposite)
          for (int next_lane = 0; next_lane < graph.edges[next].lanes; ++next_lane)
            if (network.can_turn(e, lane, next, next_lane)) network.turn(e, lane, next, next_lane);
    }
  const double half_car_m = traffic::vehicle_types[0].width_m / 2;
  double nearest = 1e9;
  for (const traffic::Link& link : network.links())
    for (const traffic::Curve::Sample& sample : link.curve.samples())
      for (const lights::PlacedLamp& lamp : set.lamps)
        nearest = std::min(nearest, glm::distance(glm::dvec2(sample.point), glm::dvec2(lamp.foot)));
  EXPECT_GT(nearest, half_car_m);
}

TEST(Kerb, NoPostStandsInTheCarriagewayWhereItsOwnStreetBendsBackOrCrossesItself) {
  const Line ring = {{0, 0}, {45, 0}, {45, 40}, {0, 40}, {0, 0}},
             hairpin = {{0, 0}, {200, 3}, {0, 6}, {200, 30}},
             crossing = {{-100, -100}, {100, 100}, {100, -100}, {-100, 100}};
  Line zigzag;
  for (int k = 0; k < 40; ++k) zigzag.emplace_back(6 * k, k % 2 ? 5 : -5);
  std::size_t posts = 0;
  for (const Line& line : {ring, hairpin, crossing, zigzag})
    for (const char* width : {"3", "6.5", "12"}) {
      const lights::LampSet set = posts_of(
          {street(1, line, {{"highway", "residential"}, {"lit", "yes"}, {"width", width}})});
      posts += set.lamps.size();
      const double kerb =
          roads::carriageway_width({{"highway", "residential"}, {"width", width}}) / 2;
      for (const lights::PlacedLamp& lamp : set.lamps)
        for (std::size_t i = 1; i < line.size(); ++i)
          EXPECT_GE(find_distance(glm::dvec2(lamp.foot), line[i - 1], line[i]), kerb - 1e-3)
              << width << " m: " << lamp.foot.x << ", " << lamp.foot.y;
    }
  EXPECT_GT(posts, 50u);
}

}  // namespace
}  // namespace nightcity::layout
