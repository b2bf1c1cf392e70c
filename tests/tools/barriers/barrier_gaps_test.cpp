// Barriers stop at gates, paths, streets and houses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "tests/tools/barriers/map_on_a_slope.h"

namespace nightcity::barriers {
namespace {

TEST(FindBarriers, GatesAndPathsAreOpenAsWideAsTheyAre) {
  const auto open_m = [](osm::OsmTags gate, const char* highway) {
    osm::OsmData map;
    map.barriers = {wall_along({{100, 100}, {150, 100}, {200, 100}})};
    if (!gate.empty()) map.gates = {{{150, 100}, std::move(gate)}};
    if (highway) map.highways = {way({{150, 80}, {150, 100}, {150, 120}}, {{"highway", highway}})};
    const BarrierSet set = find(map);
    const auto& left_out = set.report.left_out_m;
    return left_out.contains("open at gates and paths") ? left_out.at("open at gates and paths")
                                                        : 0.0;
  };
  EXPECT_EQ(open_m({}, nullptr), 0);
  EXPECT_NEAR(open_m({{"barrier", "gate"}}, nullptr), 0.9, 1e-9);
  EXPECT_NEAR(open_m({{"barrier", "lift_gate"}}, nullptr), 3, 1e-9);
  EXPECT_NEAR(open_m({{"barrier", "gate"}, {"width", "2.5"}}, nullptr), 2.5, 1e-9);
  EXPECT_NEAR(open_m({{"barrier", "gate"}, {"width", "1e9"}}, nullptr), 0.9, 1e-9);
  EXPECT_NEAR(open_m({}, "footway"), 2.5, 1e-9);
  EXPECT_NEAR(open_m({{"barrier", "gate"}}, "footway"), 2.5, 1e-9);
  EXPECT_NEAR(open_m({{"barrier", "gate"}, {"maxwidth", "1.5"}}, "footway"), 1.5, 1e-9);
}

TEST(FindBarriers, APathThatPassesAslantHasRoomOverItsWholeWidth) {
  // A wall 0.8 m thick, and paths of 2.5 m.
  for (const double degrees : {90.0, 60.0, 45.0, 135.0, 25.0}) {
    const double angle = glm::radians(degrees);
    const glm::dvec2 node(150, 100), along(std::cos(angle), std::sin(angle));
    osm::OsmData map;
    map.barriers = {thick_wall({{100, 100}, node, {200, 100}})};
    map.highways = {
        way({node - along * 20.0, node, node + along * 20.0}, {{"highway", "footway"}})};
    const BarrierSet set = find(map);
    EXPECT_NEAR(set.report.left_out_m.at("open at gates and paths"),
                (2.5 + 0.8 * std::abs(std::cos(angle))) / std::sin(angle), 1e-6);
    for (const glm::dvec3& p : find_corners(set)) {
      const glm::dvec2 from = glm::dvec2(p) - node;
      EXPECT_GE(std::abs(along.x * from.y - along.y * from.x), 1.25 - 1e-6) << degrees;
    }
  }
}

TEST(FindBarriers, CarriagewaysAndBuildingsStayFree) {
  osm::OsmData map;
  map.highways = {way({{200, -400}, {200, 400}}, {{"highway", "residential"}})};  // 5.5 m wide
  map.barriers = {wall_along({{100, 100}, {300, 100}}), wall_along({{-50, 0}, {50, 0}})};
  const BarrierSet set = find(map);
  EXPECT_NEAR(set.report.left_out_m.at("on a carriageway"), 5.5, 0.51);
  EXPECT_NEAR(set.report.left_out_m.at("in a building or below a bridge"), 20, 0.51);
  EXPECT_EQ(set.lines.size(), 4u);
}

TEST(FindBarriers, ThickWallsEndWhereTheyMeetAHouseWithBothSides) {
  for (const double slope : {-1.6, -0.7, 0.0, 0.3, 1.0, 2.0})
    for (const double within_m : {0.0, 3.0})  // the way ends on the outline, or in the house
      for (const bool turned : {false, true}) {
        osm::OsmData map;
        const glm::dvec2 at(10, 1), along(1, slope);  // it meets the house's eastern side
        map.barriers = {thick_wall({at - along * within_m, at + along * 30.0})};
        if (turned) std::reverse(map.barriers[0].lon_lat.begin(), map.barriers[0].lon_lat.end());
        const double aside = 0.4 * std::sqrt(1 + slope * slope);
        double low = 1e9, high = -1e9;  // along the side of the house
        for (const glm::dvec3& p : find_corners(find(map))) {
          EXPECT_GE(p.x, 10 - 0.005) << slope << ' ' << p.y;
          if (p.x < 10.005) low = std::min(low, p.y), high = std::max(high, p.y);
          // Feet and tops follow the ground to the corner.
          EXPECT_LT(std::min(std::abs(p.z - p.x / 10 - 2), std::abs(p.z - p.x / 10 + foot_m)),
                    0.05);
        }
        EXPECT_NEAR(low, 1 - aside, 0.02) << slope;
        EXPECT_NEAR(high, 1 + aside, 0.02) << slope;
      }
}

TEST(FindBarriers, ThickWallsEndAtBothKerbsOfAStreet) {
  osm::OsmData map;
  map.highways = {way({{200, -400}, {200, 400}}, {{"highway", "residential"}})};  // 5.5 m wide
  map.barriers = {thick_wall({{150, 100}, {203.1, 141}, {250, 170}})};
  std::size_t west = 0, east = 0;
  for (const glm::dvec3& p : find_corners(find(map))) {
    EXPECT_FALSE(p.x > 197.255 && p.x < 202.745) << p.x;
    west += std::abs(p.x - 197.25) < 0.005;
    east += std::abs(p.x - 202.75) < 0.005;
  }
  EXPECT_GE(west, 4u);
  EXPECT_GE(east, 4u);
}

TEST(FindBarriers, AStubThatIsThickerThanLongIsLeftOutAndCounted) {
  osm::OsmData map;
  map.highways = {way({{200, -400}, {200, 400}}, {{"highway", "residential"}})};  // 5.5 m wide
  map.barriers = {thick_wall({{250, 150}, {197.05, 97.05}})};  // 0.2 m beyond the western kerb
  const BarrierSet set = find(map);
  EXPECT_EQ(set.lines.size(), 1u);
  EXPECT_NEAR(set.report.left_out_m.at("thicker than long, aslant beside a house or a kerb"),
              0.2 * std::sqrt(2), 0.005);
  for (const glm::dvec3& p : find_corners(set)) EXPECT_GE(p.x, 202.745);
}

TEST(FindBarriers, AWallAlongAHouseKeepsItsLength) {
  osm::OsmData map;
  map.barriers = {thick_wall({{10.2, -30}, {10.2, 5}}), thick_wall({{100, 100}, {100, 140}})};
  const BarrierSet set = find(map);
  EXPECT_NEAR(set.report.kinds.at("wall").built_m, 75, 1e-6);
  for (const BarrierLine& line : set.lines)
    for (const BarrierEnd& end : line.ends) {
      EXPECT_EQ(end.left_m, 0);
      EXPECT_EQ(end.right_m, 0);
    }
}

}  // namespace
}  // namespace nightcity::barriers
