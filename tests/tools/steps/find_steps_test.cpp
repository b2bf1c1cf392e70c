#include "tools/steps/find_steps.h"

#include <gtest/gtest.h>

#include "tests/tools/steps/sloping_ground.h"
#include "tools/ground_cover/street_areas.h"

namespace nightcity::steps {
namespace {

// 8 m of steps up to the east: 3.2 m, which are 20 steps of 0.16 m.
const std::vector<glm::dvec2> up{{0, 0}, {8, 0}};

TEST(FindSteps, AFlightRisesAsTheGroundDoesInStepsOfEqualHeight) {
  const StepSet set = find({make_way(up)});
  ASSERT_EQ(set.flights.size(), 1u);
  const Flight& flight = set.flights[0];
  ASSERT_EQ(flight.treads_m.size(), 20u);
  // A tread is level, at the height of the ground at its upper edge, or a finger above it.
  for (std::size_t n = 0; n < 20; ++n) {
    const double above_m = flight.treads_m[n] - (100 + 0.16 * static_cast<double>(n + 1));
    EXPECT_GT(above_m, 0) << n;
    EXPECT_LT(above_m, 0.03) << n;
    EXPECT_NEAR(flight.ground_m[n], 100 + 0.16 * static_cast<double>(n), 0.1) << n;
  }
  EXPECT_EQ(flight.width_m, 2.5);
  EXPECT_EQ(set.report.treads, 20u);
  EXPECT_DOUBLE_EQ(set.report.built_m, 8);
  EXPECT_EQ(set.report.assumed.at("number of steps"), 1u);
}

TEST(FindSteps, LinesGoUpWhicheverWayTheyAreDrawn) {
  const StepSet set = find({make_way({{8, 0}, {0, 0}})});
  ASSERT_EQ(set.flights.size(), 1u);
  EXPECT_EQ(set.flights[0].line, up);
  EXPECT_EQ(set.flights[0].treads_m, find({make_way(up)}).flights[0].treads_m);
}

TEST(FindSteps, TagsSayHowManyTheyAreAndHowWide) {
  const StepSet set = find({make_way(up, {{"step_count", "16"}, {"width", "4"}})});
  ASSERT_EQ(set.flights.size(), 1u);
  EXPECT_EQ(set.flights[0].treads_m.size(), 16u);
  EXPECT_EQ(set.flights[0].width_m, 4);
  EXPECT_EQ(set.report.counted_ways, 1u);
  EXPECT_TRUE(set.report.assumed.empty());
  // Risers of 2 cm, and steps of 64 cm, are not those of a ground that rises by 3.20 m.
  for (const char* count : {"160", "5", "0", "-3", "1e9", "some"}) {
    const StepSet other = find({make_way(up, {{"step_count", count}})});
    EXPECT_EQ(other.report.treads, 20u) << count;
    EXPECT_EQ(other.report.counted_ways, 0u) << count;
  }
}

TEST(FindSteps, WhereTheGroundContradictsTheirInclineTheyArePaths) {
  for (const char* incline : {"up", "40%"})
    EXPECT_EQ(find({make_way(up, {{"incline", incline}})}).flights.size(), 1u) << incline;
  for (const char* incline : {"down", "-40%"}) {
    const StepSet set = find({make_way(up, {{"incline", incline}})});
    EXPECT_TRUE(set.flights.empty()) << incline;
    EXPECT_DOUBLE_EQ(set.report.left_out_m.at("where the ground contradicts their incline"), 8);
  }
}

TEST(FindSteps, OnLevelGroundAndOnCliffsTheyArePaths) {
  const place::HeightAt level = [](const glm::dvec2&) { return std::optional(5.0); };
  const StepSet flat = find({make_way(up)}, level);
  EXPECT_TRUE(flat.flights.empty());
  EXPECT_DOUBLE_EQ(flat.report.left_out_m.at("on level ground, where they are a path"), 8);
  const place::HeightAt gentle = [](const glm::dvec2& p) { return std::optional(0.03 * p.x); };
  EXPECT_DOUBLE_EQ(
      find({make_way(up)}, gentle)
          .report.left_out_m.at("on ground less steep than 1 in 20, where they are a path"),
      8);
  const place::HeightAt cliff = [](const glm::dvec2& p) { return std::optional(2 * p.x); };
  EXPECT_DOUBLE_EQ(find({make_way(up)}, cliff).report.left_out_m.at("steeper than stairs"), 8);
}

TEST(FindSteps, EndWhereBuildingsAndCarriagewaysBegin) {
  const place::InsideBuilding inside = [](const glm::dvec2& p) { return p.x > 2 && p.x < 4; };
  const StepSet set = find({make_way(up)}, sloping, inside);
  ASSERT_EQ(set.flights.size(), 2u);
  EXPECT_DOUBLE_EQ(set.report.left_out_m.at("in a building or below a bridge"), 2);
  EXPECT_DOUBLE_EQ(set.report.built_m, 6);

  ground_cover::Cover cover;
  const std::vector<osm::OsmWay> streets{
      {2, {{8, -100}, {8, 100}}, {{"highway", "residential"}, {"width", "5"}}}};
  ground_cover::add_streets(streets, true, as_metres, bounds, cover);
  cover.finish();
  const StepSet cut = find_steps({make_way(up)}, cover, bounds, as_metres, sloping, {});
  EXPECT_NEAR(cut.report.built_m, 5.5, 0.26);
}

TEST(FindSteps, WhatIsNoStepsOrElsewhereIsNone) {
  for (const osm::OsmTags& tags : {osm::OsmTags{{"highway", "footway"}},
                                   osm::OsmTags{{"tunnel", "yes"}}, osm::OsmTags{{"level", "-1"}},
                                   osm::OsmTags{{"indoor", "yes"}}, osm::OsmTags{{"area", "yes"}}})
    EXPECT_EQ(find({make_way(up, tags)}).report.ways, 0u);
  EXPECT_EQ(find({make_way({{9000, 0}, {9010, 0}})}).report.ways, 0u);
  EXPECT_EQ(find({make_way({{0, 0}, {0, 0}})}).report.ways, 0u);
  EXPECT_EQ(find({make_way({{std::nan(""), 0}, {8, 0}})}).report.ways, 0u);
}

TEST(FindSteps, NoTreadLiesBelowTheGround) {
  // A hump halfway, and ground that falls to the side.
  const place::HeightAt lumpy = [](const glm::dvec2& p) {
    return std::optional(0.3 * p.x + 0.1 * p.y + (p.x > 3 && p.x < 5 ? 0.5 : 0.0));
  };
  const StepSet set = find({make_way(up)}, lumpy);
  ASSERT_EQ(set.flights.size(), 1u);
  const Flight& flight = set.flights[0];
  const double tread_m = 8.0 / static_cast<double>(flight.treads_m.size());
  for (std::size_t n = 0; n < flight.treads_m.size(); ++n)
    for (const double y : {-1.25, 0.0, 1.25})
      for (const double share : {0.1, 0.5, 0.9})
        EXPECT_GT(flight.treads_m[n],
                  *lumpy({tread_m * (static_cast<double>(n) + share), y}) - 0.02);
}

}  // namespace
}  // namespace nightcity::steps
