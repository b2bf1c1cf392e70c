#include "tools/barriers/find_barriers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "tools/barriers/barrier_shape.h"
#include "tools/ground_cover/street_areas.h"

namespace nightcity::barriers {
namespace {

// Degrees stand for metres here; the ground rises eastwards within 500 m, and a house of 20 m
// stands at the origin.
const place::LonLatToFrame as_metres = [](const glm::dvec2& p) { return p; };
const place::HeightAt ground = [](const glm::dvec2& p) {
  return std::max(std::abs(p.x), std::abs(p.y)) <= 500 ? std::optional(p.x / 10) : std::nullopt;
};
const place::InsideBuilding house = [](const glm::dvec2& p) {
  return std::max(std::abs(p.x), std::abs(p.y)) < 10;
};
constexpr ground_cover::Box bounds{{-500, -500}, {500, 500}};

osm::OsmWay way(std::vector<glm::dvec2> line, osm::OsmTags tags) {
  return {1, std::move(line), std::move(tags)};
}

osm::OsmWay wall_along(std::vector<glm::dvec2> line) {
  return way(std::move(line), {{"barrier", "wall"}});
}

// A wall 0.8 m wide.
osm::OsmWay thick_wall(std::vector<glm::dvec2> line) {
  return way(std::move(line), {{"barrier", "wall"}, {"width", "0.8"}, {"height", "2"}});
}

// Corners of the shapes of all walls.
std::vector<glm::dvec3> find_corners(const BarrierSet& set) {
  std::vector<glm::dvec3> corners;
  for (const BarrierLine& line : set.lines)
    for (const Corners& triangle : make_shape(line))
      corners.insert(corners.end(), triangle.begin(), triangle.end());
  return corners;
}

BarrierSet find(const osm::OsmData& map) {
  ground_cover::Cover cover;
  ground_cover::add_streets(map.highways, true, as_metres, bounds, cover);
  cover.finish();
  BarrierSet set = find_barriers(map, cover, bounds, as_metres, ground, house);
  // Everything mapped is built or left out, and everything built lies in the lines.
  double mapped_m = 0, built_m = 0, left_out_m = 0, lines_m = 0;
  for (const auto& [name, kind] : set.report.kinds)
    mapped_m += kind.mapped_m, built_m += kind.built_m;
  for (const auto& [reason, m] : set.report.left_out_m) left_out_m += m;
  EXPECT_NEAR(mapped_m, built_m + left_out_m, 1e-9 * mapped_m + 1e-6);
  for (const BarrierLine& line : set.lines) {
    const std::size_t n = line.points.size();
    for (std::size_t i = 0; i + (line.closed ? 0 : 1) < n; ++i)
      lines_m += glm::distance(glm::dvec2(line.points[i]), glm::dvec2(line.points[(i + 1) % n]));
  }
  if (set.areas.empty()) {
    EXPECT_NEAR(lines_m, built_m, 1e-6 * (1 + built_m));
  }
  return set;
}

TEST(FindBarriers, AWallStandsOnTheGroundAlongItsWay) {
  osm::OsmData map;
  map.barriers = {wall_along({{100, 100}, {160, 100}, {160, 130}})};
  const BarrierSet set = find(map);
  ASSERT_EQ(set.lines.size(), 1u);
  EXPECT_NEAR(set.report.kinds.at("wall").built_m, 90, 1e-9);
  EXPECT_TRUE(set.report.left_out_m.empty());
  for (const glm::dvec3& p : set.lines[0].points) EXPECT_NEAR(p.z, p.x / 10, 1e-9);
  for (std::size_t i = 1; i < set.lines[0].points.size(); ++i)
    EXPECT_LE(glm::distance(set.lines[0].points[i - 1], set.lines[0].points[i]), 10.1);
}

TEST(FindBarriers, AWallFollowsBanksAndWavesOfTheGround) {
  const place::HeightAt bank = [](const glm::dvec2& p) {
    return std::optional(std::clamp(p.x - 130, 0.0, 3.0) + 2 * std::sin(p.y / 12));
  };
  osm::OsmData map;
  map.barriers = {wall_along({{100, 100}, {163, 100}, {163, 170}})};
  const BarrierSet set = find_barriers(map, {}, bounds, as_metres, bank, house);
  ASSERT_EQ(set.lines.size(), 1u);
  const std::vector<glm::dvec3>& points = set.lines[0].points;
  EXPECT_LE(points.size(), 40u);
  for (std::size_t i = 1; i < points.size(); ++i)
    for (double share = 0; share <= 1; share += 0.05) {
      const glm::dvec3 p = points[i - 1] + (points[i] - points[i - 1]) * share;
      EXPECT_NEAR(p.z, *bank(glm::dvec2(p)), 0.13) << p.x << ", " << p.y;
    }
}

TEST(FindBarriers, AClosedWallIsOneRing) {
  osm::OsmData map;
  map.barriers = {wall_along({{100, 100}, {160, 100}, {160, 130}, {100, 100}})};
  const BarrierSet set = find(map);
  ASSERT_EQ(set.lines.size(), 1u);
  EXPECT_TRUE(set.lines[0].closed);
}

TEST(FindBarriers, ARingThatIsOpenSomewhereIsOneLine) {
  osm::OsmData map;
  map.barriers = {wall_along({{100, 100}, {160, 100}, {160, 130}, {130, 130}, {100, 100}})};
  map.gates = {{{160, 130}, {{"barrier", "gate"}, {"width", "4"}}}};
  const BarrierSet set = find(map);
  ASSERT_EQ(set.lines.size(), 1u) << "it goes on across the way's first point";
  EXPECT_FALSE(set.lines[0].closed);
  EXPECT_NEAR(set.report.left_out_m.at("open at gates and paths"), 4, 1e-9);
}

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

TEST(FindBarriers, OfTwoWallsAlongOneLineTheHigherStandsWhicheverComesFirst) {
  osm::OsmData map;
  map.barriers = {way({{100, 100}, {150, 100}}, {{"barrier", "wall"}, {"height", "1"}}),
                  way({{150, 100}, {100, 100}}, {{"barrier", "wall"}, {"height", "3"}})};
  for (int round = 0; round < 2; ++round) {
    const BarrierSet set = find(map);
    ASSERT_EQ(set.lines.size(), 1u);
    EXPECT_EQ(set.lines[0].kind.height_m, 3);
    std::swap(map.barriers[0], map.barriers[1]);
  }
}

TEST(FindBarriers, OfBarriersAlongOneLineTheMostSolidStands) {
  osm::OsmData map;
  map.barriers = {way({{100, 100}, {150, 100}, {200, 100}}, {{"barrier", "fence"}}),
                  wall_along({{150, 100}, {100, 100}})};
  const BarrierSet set = find(map);
  EXPECT_NEAR(set.report.kinds.at("wall").built_m, 50, 1e-9);
  EXPECT_NEAR(set.report.kinds.at("fence").built_m, 50, 1e-9);
  EXPECT_NEAR(set.report.left_out_m.at("along a barrier that stands there"), 50, 1e-9);
}

TEST(FindBarriers, AHedgeMayBeAnArea) {
  osm::OsmData map;
  const std::vector<glm::dvec2> ring{{100, 100}, {130, 100}, {130, 104}, {100, 104}, {100, 100}};
  map.barriers = {way(ring, {{"barrier", "hedge"}, {"area", "yes"}})};
  const BarrierSet set = find(map);
  ASSERT_EQ(set.areas.size(), 1u);
  EXPECT_TRUE(set.lines.empty());
  double m2 = 0;
  for (const auto& t : set.areas[0].triangles) {
    const auto& p = set.areas[0].points;
    m2 += glm::cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).z / 2;
  }
  EXPECT_NEAR(m2, 120, 1e-6);

  map.highways = {way({{115, 50}, {115, 150}}, {{"highway", "residential"}})};
  const BarrierSet cut = find(map);
  EXPECT_TRUE(cut.areas.empty()) << "one that a street cuts stands along its outline";
  EXPECT_GT(cut.lines.size(), 1u);
}

TEST(FindBarriers, WhatLiesBeyondTheGroundIsCounted) {
  osm::OsmData map;
  map.barriers = {wall_along({{400, 0}, {600, 0}}), wall_along({{700, 0}, {800, 0}})};
  const BarrierSet set = find(map);
  EXPECT_NEAR(set.report.left_out_m.at("beyond the ground"), 200, 1e-6);
  EXPECT_NEAR(set.report.kinds.at("wall").built_m, 100, 1e-6);
}

TEST(FindBarriers, AHostileMapEndsWithACount) {
  const double nan = std::nan("");
  osm::OsmData map;
  std::vector<glm::dvec2> star, tangle;
  for (int i = 0; i < 20'000; ++i) {
    star.push_back({i % 2 ? 490.0 : -490.0, i % 400 - 200.0 + i * 1e-4});
    tangle.push_back({150 + 40 * std::sin(7.0 * i), 150 + 40 * std::cos(11.0 * i)});
  }
  tangle.push_back(tangle.front());
  map.barriers = {wall_along({{-1e9, 20}, {1e9, 21}}),
                  wall_along({{nan, nan}, {nan, nan}}),
                  wall_along({{30, 30}, {30, 30}}),
                  wall_along({}),
                  wall_along({{20, 0}, {40, 0}, {20, 0}, {40, 0}, {30, 5}, {30, -5}}),
                  wall_along(star),
                  way(tangle, {{"barrier", "hedge"}, {"area", "yes"}, {"height", "1e9"}}),
                  way({{50, 50}, {60, 60}}, {{"barrier", std::string(100'000, 'x')}})};
  const BarrierSet set = find(map);
  EXPECT_GT(set.report.left_out_m.at("beyond the first 4000 km"), 0);
  for (const BarrierLine& line : set.lines) EXPECT_LE(line.kind.height_m, 30);
}

TEST(FindBarriers, TheOrderOfTheMapsWaysOfOneKindDecidesNothing) {
  osm::OsmData map, turned;
  map.barriers = {wall_along({{100, 100}, {150, 100}}), wall_along({{150, 100}, {150, 200}})};
  turned.barriers = {map.barriers[1], map.barriers[0]};
  EXPECT_EQ(find(map).report.left_out_m, find(turned).report.left_out_m);
  EXPECT_EQ(find(map).lines.size(), find(turned).lines.size());
}

}  // namespace
}  // namespace nightcity::barriers
