#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/tools/bridges/bridge_map.h"
#include "tools/bridges/bridge_decks.h"
#include "tools/ring_area.h"

namespace nightcity::bridges {
namespace {

using test::bridge;
using test::residential;
using test::way;

BridgeDecks find(const std::vector<osm::OsmWay>& highways,
                 const std::vector<osm::OsmWay>& railways = {},
                 const place::HeightAt& ground = test::level_ground) {
  return find_decks({highways, railways}, test::to_metres, ground);
}

TEST(FindDecks, ABridgeOnFlatGroundClearsTheStreetThatItCrosses) {
  const BridgeDecks decks = find(test::street_over_street());
  ASSERT_EQ(decks.decks().size(), 1u);
  EXPECT_NEAR(decks.height_at(1, {0, 0}).value(), 30 + 4.5 + deck_m, 1e-6);
  EXPECT_NEAR(decks.height_at(1, {-100, 0}).value(), 30, 1e-9);
  EXPECT_NEAR(decks.height_at(1, {100, 0}).value(), 30, 1e-9);
  for (double x = -100; x < 100; ++x) {
    const double slope =
        decks.height_at(1, {x + 1, 0}).value() - decks.height_at(1, {x, 0}).value();
    EXPECT_LE(std::abs(slope), 0.08 + 1e-9) << x;
  }
  EXPECT_NEAR(decks.find_soffit({0, 3, 30}).value(), 34.5, 1e-6) << "the clear height";
  EXPECT_EQ(decks.report().built.at("streets").bridges, 1u);
  EXPECT_NEAR(decks.report().built.at("streets").length_m, 200, 1e-6);
  EXPECT_EQ(decks.report().low, 0u);
}

// Returns the least clear height between a deck and a straight street below it, over the width of
// both. `reach_m`: how far along the street is asked.
double find_least_clear_m(const BridgeDecks& decks, const osm::OsmWay& below,
                          const place::HeightAt& ground, double reach_m) {
  const glm::dvec2 a = test::to_metres(below.lon_lat[0]), b = test::to_metres(below.lon_lat[1]);
  const glm::dvec2 middle = (a + b) / 2.0, along = glm::normalize(b - a), left(-along.y, along.x);
  const double half_m = find_half_width_m(below.tags, Carried::street);
  double least_m = 1e9;
  for (double s = -reach_m; s <= reach_m; s += 0.05)
    for (double share = -1; share <= 1; share += 0.125) {
      const glm::dvec2 p = middle + along * s + left * (half_m * share);
      if (const auto soffit = decks.find_soffit({p, *ground(p)}))
        least_m = std::min(least_m, *soffit - *ground(p));
    }
  return least_m;
}

// A bridge that has room to rise above what it crosses on a slope.
std::vector<osm::OsmWay> long_bridge(osm::OsmWay below) {
  return {way(1, {{-900, 0}, {-400, 0}}, residential), way(2, {{-400, 0}, {400, 0}}, bridge),
          way(3, {{400, 0}, {900, 0}}, residential), std::move(below)};
}

TEST(FindDecks, TheClearHeightHoldsOverTheWholeWidthOfAStreetOnASlope) {
  for (const double east : {0.0, 0.03, -0.03})
    for (const double north : {0.0, 0.05, -0.09}) {
      const place::HeightAt slope = [&](const glm::dvec2& p) {
        return std::optional(30 + east * p.x + north * p.y);
      };
      const std::vector<osm::OsmWay> ways = long_bridge(way(4, {{0, -300}, {0, 300}}, residential));
      const BridgeDecks decks = find(ways, {}, slope);
      ASSERT_EQ(decks.decks().size(), 1u);
      EXPECT_EQ(decks.report().low, 0u);
      const double least_m = find_least_clear_m(decks, ways[3], slope, 20);
      EXPECT_GE(least_m, 4.49) << east << ' ' << north;
      // The deck has places 2 m apart, between which it may rise by 8 %.
      EXPECT_LE(least_m, 4.5 + 2 * 0.08) << east << ' ' << north;
    }
}

TEST(FindDecks, TheClearHeightHoldsUnderTheWholeDeckOfABridgeThatCrossesAslant) {
  for (const double degrees : {12.0, 25.0, 40.0, 70.0, 110.0, 160.0}) {
    const double angle = degrees * 3.14159265358979 / 180;
    const glm::dvec2 along(std::cos(angle), std::sin(angle));
    const place::HeightAt slope = [](const glm::dvec2& p) {
      return std::optional(30 + 0.02 * p.x + 0.07 * p.y);
    };
    const std::vector<osm::OsmWay> ways =
        long_bridge(way(4, {along * -300.0, along * 300.0}, residential));
    const BridgeDecks decks = find(ways, {}, slope);
    ASSERT_EQ(decks.decks().size(), 1u) << degrees;
    EXPECT_EQ(decks.report().low, 0u) << degrees;
    EXPECT_GE(find_least_clear_m(decks, ways[3], slope, 290), 4.49) << degrees;
  }
}

TEST(FindDecks, IdsOfWaysDecideNothing) {
  // Two ways lead on from the end of a bridge at the same angle: either might be its deck's.
  const auto heights = [](std::int64_t left, std::int64_t right) {
    std::vector<osm::OsmWay> ways = test::street_over_street();
    ways[3] = way(4, {{200, 50}, {300, 50}}, residential);
    ways.push_back(way(left, {{100, 0}, {200, 50}}, bridge));
    ways.push_back(way(right, {{100, 0}, {200, -50}}, bridge));
    ways.push_back(way(9, {{200, -50}, {300, -50}}, residential));
    const BridgeDecks decks = find(ways);
    std::vector<double> out;
    for (const glm::dvec2 p : {glm::dvec2{-50, 0}, {50, 0}, {100, 0}, {150, 25}, {150, -25}})
      out.push_back(decks.height_at(1, p).value_or(0));
    return out;
  };
  EXPECT_EQ(heights(7, 8), heights(8, 7));
}

TEST(FindDecks, TheOutlineHasTheLengthTimesTheWidth) {
  const BridgeDecks decks = find(test::street_over_street());
  const Deck& deck = decks.decks()[0];
  ASSERT_EQ(deck.outline.size(), 1u);
  EXPECT_NEAR(std::abs(signed_area(deck.outline[0])), 200 * 2 * deck.half_m, 1e-6);
  EXPECT_TRUE(decks.covers({50, deck.half_m - 0.1}));
  EXPECT_FALSE(decks.covers({50, deck.half_m + 0.1}));
  EXPECT_FALSE(decks.covers({100.1, 0}));
}

TEST(FindDecks, TheOrderAndTheDirectionOfWaysDoNotMatter) {
  std::vector<osm::OsmWay> ways = test::street_over_street();
  const BridgeDecks first = find(ways);
  std::reverse(ways.begin(), ways.end());
  for (osm::OsmWay& way : ways) std::reverse(way.lon_lat.begin(), way.lon_lat.end());
  const BridgeDecks second = find(ways);
  ASSERT_EQ(second.decks().size(), 1u);
  EXPECT_EQ(first.decks()[0].heights_m, second.decks()[0].heights_m);
  EXPECT_EQ(first.decks()[0].outline, second.decks()[0].outline);
}

TEST(FindDecks, AValleyIsSpannedFromAbutmentToAbutment) {
  const place::HeightAt valley = [](const glm::dvec2& p) -> std::optional<double> {
    return std::abs(p.x) < 99 ? 10.0 : 30 + p.x / 100;
  };
  const BridgeDecks decks = find(test::street_over_street(), {}, valley);
  ASSERT_EQ(decks.decks().size(), 1u);
  for (double x = -100; x <= 100; x += 10)
    EXPECT_NEAR(decks.height_at(1, {x, 0}).value(), 30 + x / 100, 1e-9);
}

TEST(FindDecks, WhatIsTooShortOrSpansNothingStaysOnTheGround) {
  const std::vector<osm::OsmWay> one_way{way(1, {{-300, 0}, {-20, 0}}, residential),
                                         way(2, {{-20, 0}, {20, 0}}, bridge),
                                         way(3, {{20, 0}, {300, 0}}, residential)};
  EXPECT_EQ(find(one_way).report().on_ground.at("nothing below it").bridges, 1u);
  std::vector<osm::OsmWay> crossing = one_way;
  crossing.push_back(way(4, {{0, -50}, {0, 50}}, residential));
  const BridgeReport report = find(crossing).report();
  EXPECT_TRUE(report.built.empty());
  EXPECT_NEAR(report.on_ground.at("too short to rise above what it crosses").length_m, 40, 1e-6);
}

TEST(FindDecks, BridgesNeedTwoAbutments) {
  std::vector<osm::OsmWay> ways = test::street_over_street();
  ways.erase(ways.begin() + 3);
  const BridgeReport report = find(ways).report();
  EXPECT_EQ(report.on_ground.at("no abutment at an end").bridges, 1u);
}

TEST(FindDecks, AFootbridgeBetweenStairsIsLevelAtItsClearHeight) {
  const osm::OsmTags steps{{"highway", "steps"}}, path{{"highway", "footway"}, {"bridge", "yes"}};
  const std::vector<osm::OsmWay> ways{
      way(1, {{-30, 0}, {-20, 0}}, steps), way(2, {{-20, 0}, {20, 0}}, path),
      way(3, {{20, 0}, {30, 0}}, steps), way(4, {{0, -50}, {0, 50}}, residential)};
  const BridgeDecks decks = find(ways);
  ASSERT_EQ(decks.decks().size(), 1u);
  for (double x = -20; x <= 20; x += 5) EXPECT_NEAR(decks.height_at(1, {x, 0}).value(), 35.3, 1e-6);
}

TEST(FindDecks, BeyondTheModelTheDeckGoesOnLevel) {
  const place::HeightAt part = [](const glm::dvec2& p) {
    return std::abs(p.x) < 60 ? std::optional(30.0) : std::nullopt;
  };
  const BridgeDecks decks = find(test::street_over_street(), {}, part);
  ASSERT_EQ(decks.decks().size(), 1u);
  EXPECT_NEAR(decks.decks()[0].length_m(), 120, 5);
  for (double x = -57; x <= 57; x += 19)
    EXPECT_NEAR(decks.height_at(1, {x, 0}).value(), 35.3, 1e-6);
}

TEST(FindDecks, ABridgeClearsABridgeOfALowerLayer) {
  std::vector<osm::OsmWay> ways = test::street_over_street();
  const osm::OsmTags above = test::with(bridge, {{"layer", "2"}});
  ways.push_back(way(6, {{50, -500}, {50, -400}}, residential));
  ways.push_back(way(7, {{50, -400}, {50, 400}}, above));
  ways.push_back(way(8, {{50, 400}, {50, 500}}, residential));
  const BridgeDecks decks = find(ways);
  ASSERT_EQ(decks.decks().size(), 2u);
  // The lower one falls eastwards here: its highest place is below the edge of the upper one.
  const double edge = 50 - decks.decks()[1].half_m;
  EXPECT_NEAR(decks.height_at(2, {50, 0}).value(),
              decks.height_at(1, {edge, 0}).value() + 4.5 + deck_m, 1e-6);
}

TEST(FindDecks, RampsEndOnTheBridgeThatTheyMeet) {
  std::vector<osm::OsmWay> ways = test::street_over_street();
  ways.push_back(way(6, {{10, 0}, {60, -100}, {160, -100}}, bridge));
  ways.push_back(way(7, {{160, -100}, {300, -100}}, residential));
  const BridgeDecks decks = find(ways);
  ASSERT_EQ(decks.decks().size(), 2u);
  const double meeting_m = decks.height_at(1, {10, 0}).value();
  EXPECT_GT(meeting_m, 34);
  EXPECT_NEAR(decks.decks()[1].heights_m.front(), meeting_m, 1e-9);
  EXPECT_NEAR(decks.decks()[1].heights_m.back(), 30, 1e-9);
}

TEST(FindDecks, APathEndsOnTheBridgeOfAStreet) {
  std::vector<osm::OsmWay> ways = test::street_over_street();
  const osm::OsmTags path{{"highway", "footway"}};
  ways.push_back(way(6, {{10, 0}, {60, -100}}, test::with(path, {{"bridge", "yes"}})));
  ways.push_back(way(7, {{60, -100}, {60, -200}}, path));
  const BridgeDecks decks = find(ways);
  ASSERT_EQ(decks.decks().size(), 2u);
  EXPECT_EQ(decks.decks()[1].kind, Carried::path);
  EXPECT_NEAR(decks.decks()[1].heights_m.front(), decks.height_at(1, {10, 0}).value(), 1e-9);
}

TEST(FindDecks, TracksInAStreetHaveItsDeck) {
  const osm::OsmTags tram{{"railway", "tram"}, {"bridge", "yes"}, {"layer", "1"}};
  const std::vector<osm::OsmWay> trams{way(20, {{-95, 1}, {95, 1}}, tram)};
  const BridgeDecks decks = find(test::street_over_street(), trams);
  EXPECT_EQ(decks.decks().size(), 1u);
  ASSERT_TRUE(decks.find(20));
  EXPECT_TRUE(decks.find(20)->is_guest);
}

TEST(FindDecks, WhatStandsBesideADeckStandsOnIt) {
  const BridgeDecks decks = find(test::street_over_street());
  const Deck& deck = decks.decks()[0];
  const auto place = decks.find_place(2, {-20, deck.half_m + 0.5});
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->y, deck.half_m - 0.35, 1e-9);
  EXPECT_NEAR(place->z, decks.height_at(1, {-20, 0}).value(), 1e-9);
  EXPECT_FALSE(decks.find_place(2, {-20, deck.half_m + 1.5}));
  EXPECT_FALSE(decks.find_place(2, {-101, 0})) << "before the abutment";
  EXPECT_FALSE(decks.find_place(5, {0, 0})) << "the street below stays below";
}

TEST(FindDecks, DecksThatOverlapHaveNoStepBetweenThem) {
  // Two carriageways side by side, from abutments of which one pair is a metre higher.
  const place::HeightAt ground = [](const glm::dvec2& p) -> std::optional<double> {
    return (std::abs(p.x) < 99 ? 10.0 : 30.0) + (p.y > 4 ? 1 : 0);
  };
  std::vector<osm::OsmWay> ways;
  for (const double y : {0.0, 8.0}) {
    const auto id = static_cast<std::int64_t>(10 * y);
    ways.push_back(way(id + 1, {{-300, y}, {-100, y}}, residential));
    ways.push_back(way(id + 2, {{-100, y}, {100, y}}, bridge));
    ways.push_back(way(id + 3, {{100, y}, {300, y}}, residential));
  }
  const BridgeDecks decks = find(ways, {}, ground);
  ASSERT_EQ(decks.decks().size(), 2u);
  double before_m = decks.height_at(1, {0, -5}).value();
  for (double y = -5; y <= 13; y += 0.05) {
    const double height_m = decks.height_at(1, {0, y}).value();
    EXPECT_LT(std::abs(height_m - before_m), 0.05) << y;
    before_m = height_m;
  }
  EXPECT_NEAR(decks.height_at(1, {0, 0}).value(), 30, 1e-6);
  EXPECT_NEAR(decks.height_at(1, {0, 8}).value(), 31, 1e-6);
}

TEST(FindDecks, TunnelsRingsAndNonsenseAreNoBridges) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<osm::OsmWay> ways{
      way(1, {{-300, 0}, {-100, 0}}, residential),
      way(2, {{-100, 0}, {100, 0}}, test::with(residential, {{"tunnel", "yes"}, {"layer", "-1"}})),
      way(3, {{0, nan}, {nan, 0}}, bridge), way(4, {{1e12, 0}, {1e13, 0}}, bridge),
      way(5, {{0, 0}, {50, 0}, {50, 50}, {0, 0}}, bridge)};
  const BridgeDecks decks = find(ways);
  EXPECT_TRUE(decks.empty());
  EXPECT_EQ(decks.report().on_ground.size(), 1u);
  EXPECT_EQ(decks.report().on_ground.at("a ring without an abutment").bridges, 1u);
}

}  // namespace
}  // namespace nightcity::bridges
