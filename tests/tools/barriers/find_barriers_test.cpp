#include "tools/barriers/find_barriers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/tools/barriers/map_on_a_slope.h"

namespace nightcity::barriers {
namespace {

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
