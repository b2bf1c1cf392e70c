// The sea on the right of coastlines: its area is known in closed form.
#include "tools/ground_cover/sea.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/tools/ground_cover/metre_map.h"
#include "tests/tools/ground_cover/plan_areas.h"
#include "tools/ground_cover/clip_segment.h"
#include "tools/ground_cover/land_areas.h"

namespace nightcity::ground_cover {
namespace {

const osm::OsmTags coastline{{"natural", "coastline"}};
constexpr double all_m2 = 1000.0 * 1000.0;  // of the ground

Cover lay_sea(const std::vector<Line>& lines,
              const std::optional<osm::LonLatBox>& map_bounds = std::nullopt) {
  std::vector<osm::OsmWay> ways;
  for (const Line& line : lines) ways.push_back(way(line, coastline));
  Cover cover;
  add_sea(ways, map_bounds, as_metres, bounds, cover);
  cover.finish();
  return cover;
}

// The sum over tiles, as a scene is written.
double find_water_m2(const Cover& cover) {
  constexpr double tile_m = 100;
  double sum_m2 = 0;
  for (double x = bounds.low.x; x < bounds.high.x; x += tile_m)
    for (double y = bounds.low.y; y < bounds.high.y; y += tile_m) {
      const auto areas = areas_of(cover, {{x, y}, {x + tile_m, y + tile_m}});
      if (const auto water = areas.find("water"); water != areas.end()) sum_m2 += water->second;
    }
  return sum_m2;
}

Line reversed(Line line) {
  std::reverse(line.begin(), line.end());
  return line;
}

// Anticlockwise, as an island's coast runs.
Line ring(const glm::dvec2& centre, double radius_m, int corners = 4) {
  Line line;
  for (int i = 0; i < corners; ++i) {
    const double turn = 2 * std::numbers::pi * i / corners;
    line.push_back(centre + glm::dvec2(std::cos(turn), std::sin(turn)) * radius_m);
  }
  line.push_back(line.front());
  return line;
}

const Line north{{0, -600}, {0, 600}};  // water in the east

TEST(Sea, TheWaterLiesOnTheRightOfItsCoast) {
  const Cover east = lay_sea({north}), west = lay_sea({reversed(north)});
  EXPECT_NEAR(find_water_m2(east), all_m2 / 2, 1);
  EXPECT_NEAR(find_water_m2(west), all_m2 / 2, 1);
  EXPECT_EQ(east.surface_at({10, 3})->kind, GroundKind::water);
  EXPECT_EQ(east.surface_at({-10, 3}), nullptr);
  EXPECT_EQ(west.surface_at({10, 3}), nullptr);
  EXPECT_TRUE(east.left_out_m.empty());
  EXPECT_TRUE(east.assumed.empty());
}

TEST(Sea, WaysAreJoinedInAnyOrderAndOneThatRunsBackwardsIsCounted) {
  const std::vector<Line> pieces{
      {{0, 100}, {0, 600}}, {{0, -600}, {0, -300}}, {{0, -300}, {0, 100}}};
  EXPECT_NEAR(find_water_m2(lay_sea(pieces)), all_m2 / 2, 1);
  for (std::size_t n = 1; n < pieces.size(); ++n) {
    std::vector<Line> lines = pieces;
    lines[n] = reversed(lines[n]);
    const Cover cover = lay_sea(lines);
    EXPECT_NEAR(find_water_m2(cover), all_m2 / 2, 1);
    EXPECT_EQ(cover.surface_at({10, 3})->kind, GroundKind::water);
    EXPECT_EQ(cover.assumed.at("side of the sea at a coastline that contradicts the others"), 1u);
  }
}

TEST(Sea, IslandsAreLandAndLagoonsAreWater) {
  const Line island = ring({250, 0}, 100), lagoon = reversed(ring({-250, 0}, 100));
  const Cover both = lay_sea({north, island, lagoon, ring({-250, 0}, 10)});
  EXPECT_NEAR(find_water_m2(both), all_m2 / 2 - 2e4 + 2e4 - 200, 2);
  EXPECT_EQ(both.surface_at({250, 0}), nullptr);
  EXPECT_EQ(both.surface_at({-250, 50})->kind, GroundKind::water);
  EXPECT_EQ(both.surface_at({-250, 0}), nullptr);
  EXPECT_TRUE(both.assumed.empty());
  // No coast but an island's: the ground lies in the sea. No coast but a lagoon's: it is land.
  EXPECT_NEAR(find_water_m2(lay_sea({island})), all_m2 - 2e4, 2);
  EXPECT_NEAR(find_water_m2(lay_sea({lagoon})), 2e4, 2);
  // An island that is drawn backwards stays one.
  const Cover backward = lay_sea({north, reversed(island)});
  EXPECT_NEAR(find_water_m2(backward), all_m2 / 2 - 2e4, 2);
  EXPECT_EQ(backward.assumed.size(), 1u);
}

TEST(Sea, CoastsAreClosedAlongTheSidesOfTheGround) {
  // A strait from west to east, a corner, and a coast that comes and goes on one side.
  const Cover strait = lay_sea({{{-600, -100}, {600, -100}}, {{600, 50}, {-600, 50}}});
  EXPECT_NEAR(find_water_m2(strait), all_m2 - 150e3, 1) << "land between, on the left of both";
  const Cover water = lay_sea({{{600, -100}, {-600, -100}}, {{-600, 50}, {600, 50}}});
  EXPECT_NEAR(find_water_m2(water), 150e3, 1);
  const Cover corner = lay_sea({{{200, 600}, {200, 200}, {600, 200}}});
  EXPECT_NEAR(find_water_m2(corner), all_m2 - 300.0 * 300, 1);
  const Cover bay = lay_sea({{{600, 100}, {200, 100}, {200, -100}, {600, -100}}});
  EXPECT_NEAR(find_water_m2(bay), all_m2 - 300.0 * 200, 1);
  const Cover ring_across =
      lay_sea({{{400, -100}, {700, -100}, {700, 100}, {400, 100}, {400, -100}}});
  EXPECT_NEAR(find_water_m2(ring_across), all_m2 - 100.0 * 200, 1) << "an island beyond the ground";
}

// The sum over triangles agrees with the sum of the outlines' trapezoids.
TEST(Sea, ACoastOfManyIslandsHasTheAreaOfItsOutlines) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> spread(-0.4, 0.4);
  std::vector<Line> lines{{}};
  double expected_m2 = 0;
  for (int i = 0; i <= 240; ++i) lines[0].push_back({20 * spread(random), -600.0 + 5 * i});
  for (std::size_t i = 1; i < lines[0].size(); ++i) {
    const auto part = clip_segment(lines[0][i - 1], lines[0][i], bounds);
    if (!part) continue;
    const glm::dvec2 along = lines[0][i] - lines[0][i - 1],
                     a = lines[0][i - 1] + along * part->first,
                     b = lines[0][i - 1] + along * part->second;
    expected_m2 += (500 - (a.x + b.x) / 2) * (b.y - a.y);
  }
  for (int x = 40; x < 480; x += 20)
    for (int y = -480; y < 480; y += 20) {
      const double radius_m = 5 + 5 * spread(random);
      lines.push_back(ring({x + spread(random), y + spread(random)}, radius_m, 12));
      expected_m2 -= 6 * radius_m * radius_m * std::sin(std::numbers::pi / 6);
    }
  std::shuffle(lines.begin(), lines.end(), random);
  EXPECT_NEAR(find_water_m2(lay_sea(lines)), expected_m2, 0.001 * expected_m2);
}

TEST(Sea, ACoastThatEndsWithinTheMapIsCounted) {
  const Line open{{0, -600}, {0, 0}};
  const Cover none = lay_sea({open});
  EXPECT_EQ(find_water_m2(none), 0);
  EXPECT_NEAR(none.left_out_m.at("coastline that ends within the map"), 500, 2);
  // No one knows whether the land behind it belongs to islands beside it.
  const Cover doubtful = lay_sea({open, ring({250, 0}, 100)});
  EXPECT_EQ(find_water_m2(doubtful), 0);
  EXPECT_NEAR(
      doubtful.left_out_m.at("coastline whose sea is in doubt, as another one ends within the map"),
      400 * std::sqrt(2.0), 1);
  // Land is all that the others part from the sea.
  const Cover on_land = lay_sea({north, {{-300, 0}, {-200, 0}}});
  EXPECT_NEAR(find_water_m2(on_land), all_m2 / 2, 1);
  EXPECT_NEAR(on_land.left_out_m.at("coastline that ends within the map"), 100, 1e-6);
}

TEST(Sea, WhereAnExtractEndsBeforeTheGroundTheSeaDoesToo) {
  const Line coast{{0, -450}, {0, 420}};
  const osm::LonLatBox extract{{-300, -300}, {300, 300}};
  const Cover cover = lay_sea({coast}, extract);
  EXPECT_NEAR(find_water_m2(cover), 300.0 * 600, 5);
  EXPECT_TRUE(cover.left_out_m.empty());
  EXPECT_NEAR(find_water_m2(lay_sea({north}, extract)), all_m2 / 2, 1) << "which reaches the end";
  EXPECT_EQ(find_water_m2(lay_sea({{{0, -100}, {0, 420}}}, extract)), 0) << "far from its edge";
}

// Extracts without the nodes beyond their bounds: a coast ends at its last node within.
TEST(Sea, ACoastThatEndsNearTheEdgeOfItsMapGoesOnToIt) {
  const osm::LonLatBox extract{{-300, -300}, {300, 300}};
  const Cover cover = lay_sea({{{0, -240}, {0, 0}}, {{0, 0}, {0, 270}}}, extract);
  EXPECT_NEAR(find_water_m2(cover), 300.0 * 600, 5);
  EXPECT_EQ(cover.assumed.at("way of a coastline to the edge of its map"), 2u);
  EXPECT_TRUE(cover.left_out_m.empty());
  const Cover at_edge = lay_sea({{{0, -300}, {0, 300}}}, extract);
  EXPECT_NEAR(find_water_m2(at_edge), 300.0 * 600, 5);
}

TEST(Sea, WhatTheMapSaysOfLandLiesOverTheSea) {
  std::vector<osm::OsmWay> ways{way(north, coastline)};
  const std::vector<osm::MapArea> areas{
      {"way/1", {{"natural", "beach"}}, {{{{-50, -50}, {50, -50}, {50, 50}, {-50, 50}}, {}}}}};
  Cover cover;
  add_land(areas, as_metres, bounds, cover);
  add_sea(ways, std::nullopt, as_metres, bounds, cover);
  cover.finish();
  EXPECT_EQ(cover.surface_at({10, 0})->kind, GroundKind::sand);
  EXPECT_EQ(cover.surface_at({60, 0})->kind, GroundKind::water);
}

TEST(Sea, HostileCoastsEndWithoutACrash) {
  const double nan = std::nan("");
  lay_sea({{{nan, 0}, {0, nan}}, {{0, 0}, {0, 0}}, {{0, 0}}, {{-1e300, 0}, {1e300, 0}}});
  lay_sea({{{-600, -600}, {600, 600}}, {{600, -600}, {-600, 600}}, {{-600, 0}, {600, 0}}});
  lay_sea({{{-501.0471, 0}, {0, 0}, {-501.0471, 1}}, {{-500, -500}, {500, -500}, {500, 500}}});
  lay_sea({{{0, 0}, {100, 100}, {100, 0}, {0, 100}, {0, 0}}, {{0, 0}, {-600, 0}}});
}

// Corners of a coarse grid: lines run along each other, touch and cross, and end anywhere.
TEST(Sea, RandomCoastsCoverNoMoreThanTheGround) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const auto at = [&] { return (static_cast<double>(random() % 13) - 6) * 100; };
    std::vector<Line> lines(1 + random() % 5);
    for (Line& line : lines) {
      for (std::size_t n = 2 + random() % 6; n > 0; --n) line.push_back({at(), at()});
      if (random() % 3 == 0) line.push_back(line.front());
    }
    const double water_m2 = find_water_m2(
        lay_sea(lines, random() % 2 ? std::optional(osm::LonLatBox{{-400, -300}, {300, 500}})
                                    : std::nullopt));
    EXPECT_GE(water_m2, 0);
    EXPECT_LE(water_m2, all_m2 * (1 + 1e-9)) << seed;
  }
}

}  // namespace
}  // namespace nightcity::ground_cover
