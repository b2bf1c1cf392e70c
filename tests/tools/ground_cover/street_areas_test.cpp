#include "tools/ground_cover/street_areas.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "tests/tools/ground_cover/metre_map.h"
#include "tests/tools/ground_cover/plan_areas.h"
#include "tools/ring_area.h"

namespace nightcity::ground_cover {
namespace {

Cover cover_streets(const std::vector<osm::OsmWay>& ways, bool markings = false,
                    const std::vector<osm::OsmPoint>& controls = {}, bool on_the_left = false) {
  Cover cover;
  add_streets(ways, true, as_metres, bounds, cover);
  if (markings) add_markings({ways, controls, {}, on_the_left}, as_metres, bounds, cover);
  cover.finish();
  return cover;
}

TEST(StreetAreas, AStreetIsAsWideAsTheRoadTableSaysAndHasPavements) {
  const auto areas =
      areas_of(cover_streets({way({{-200, 0}, {200, 0}}, {{"highway", "residential"}})}), middle);
  EXPECT_NEAR(areas.at("asphalt"), 100 * 5.5, 0.1);  // two lanes of 2.75 m
  EXPECT_NEAR(areas.at("sunken"), 100 * 5.5, 0.1);
  EXPECT_NEAR(areas.at("paving stones"), 100 * 2 * 2.5, 0.2);
}

TEST(StreetAreas, TagsSayWhatRunsBesideIt) {
  const auto widths = [](osm::OsmTags tags) {
    tags["highway"] = "residential";
    auto areas = areas_of(cover_streets({way({{-200, 0}, {200, 0}}, std::move(tags))}), middle);
    return std::pair(areas["asphalt"] / 100, areas["paving stones"] / 100);
  };
  EXPECT_NEAR(widths({{"sidewalk", "no"}}).second, 0, 1e-2);
  EXPECT_NEAR(widths({{"sidewalk", "separate"}}).second, 0, 1e-2);
  EXPECT_NEAR(widths({{"sidewalk", "left"}}).second, 2.5, 1e-2);
  EXPECT_NEAR(widths({{"sidewalk:both", "yes"}}).second, 5, 1e-2);
  EXPECT_NEAR(widths({{"sidewalk:right", "yes"}, {"sidewalk:right:width", "4 m"}}).second, 6.5,
              1e-2);
  EXPECT_NEAR(widths({{"cycleway", "track"}}).first, 5.5 + 2 * 2, 1e-2);
  EXPECT_NEAR(widths({{"cycleway:right", "track"}, {"sidewalk", "no"}}).first, 7.5, 1e-2);
  EXPECT_NEAR(widths({{"surface", "paving_stones"}, {"sidewalk", "no"}}).second, 5.5, 1e-2);
}

TEST(StreetAreas, JunctionsAreFilledAndCountOnce) {
  const Cover cover =
      cover_streets({way({{-200, 0}, {200, 0}}, {{"highway", "residential"}, {"sidewalk", "no"}}),
                     way({{0, -200}, {0, 200}}, {{"highway", "residential"}, {"sidewalk", "no"}})});
  EXPECT_NEAR(areas_of(cover, middle).at("asphalt"), 100 * 5.5 + 80 * 5.5 - 5.5 * 5.5, 0.1);
}

TEST(StreetAreas, TheMoreImportantRoadIsSeenWhereTwoCross) {
  const auto areas =
      areas_of(cover_streets(
                   {way({{-200, 0}, {200, 0}}, {{"highway", "residential"}, {"surface", "sett"}}),
                    way({{0, -200}, {0, 200}}, {{"highway", "primary"}, {"surface", "concrete"}})}),
               middle);
  EXPECT_NEAR(areas.at("concrete"), 80 * 6.5, 0.1);
  EXPECT_NEAR(areas.at("sett"), (100 - 6.5) * 5.5, 0.1);
}

// The greater road does not show its round end in the lesser one, which goes on from there.
TEST(StreetAreas, WhichOfTwoEqualRoadsIsSeenDoesNotDependOnTheirOrder) {
  const auto made_of = [](const char* surface, const char* width) {
    return osm::OsmTags{{"highway", "residential"}, {"surface", surface}, {"width", width}};
  };
  const osm::OsmWay narrow = way({{-200, 0}, {200, 0}}, made_of("sett", "5")),
                    wide = way({{0, -100}, {0, 100}}, made_of("gravel", "6")),
                    shorter = way({{-20, -100}, {-20, 100}}, made_of("concrete", "5"));
  const auto areas = areas_of(cover_streets({narrow, wide, shorter}), middle);
  EXPECT_EQ(areas, areas_of(cover_streets({shorter, wide, narrow}), middle));
  EXPECT_EQ(areas, areas_of(cover_streets({wide, narrow, shorter}), middle));
  EXPECT_NEAR(areas.at("gravel"), 80 * 6, 0.1);
  EXPECT_NEAR(areas.at("sett"), 100 * 5 - 6 * 5, 0.1);
  EXPECT_NEAR(areas.at("concrete"), 80 * 5 - 5 * 5, 0.1);
}

TEST(StreetAreas, AStreetThatChangesItsClassChangesThereAndNotBeyond) {
  const auto areas = areas_of(
      cover_streets({way({{-200, 0}, {0, 0}},
                         {{"highway", "primary"}, {"surface", "concrete"}, {"sidewalk", "no"}}),
                     way({{0, 0}, {200, 0}},
                         {{"highway", "residential"}, {"surface", "sett"}, {"sidewalk", "no"}})}),
      middle);
  EXPECT_NEAR(areas.at("sett"), 50 * 5.5, 0.1);
  // The end is seen beside the lesser street: in two segments of a circle, cut in half, of which a
  // polygon of 16 sides has a little less.
  const double r = 3.25, d = 2.75,
               segment = r * r * std::acos(d / r) - d * std::sqrt(r * r - d * d);
  EXPECT_GT(areas.at("concrete"), 50 * 6.5 + segment - 0.2);
  EXPECT_LT(areas.at("concrete"), 50 * 6.5 + segment);
}

TEST(StreetAreas, AStreetThatEndsIsRound) {
  const auto areas = areas_of(
      cover_streets({way({{-200, 0}, {0, 0}}, {{"highway", "residential"}, {"sidewalk", "no"}})}),
      middle);
  const double sixteen = 8 * std::sin(std::numbers::pi / 8);  // a circle's area by its 16-gon
  EXPECT_NEAR(areas.at("asphalt"), 50 * 5.5 + sixteen / 2 * 2.75 * 2.75, 0.1);
}

TEST(StreetAreas, APathIsSeenBeforeThePavementThatAStreetIsGiven) {
  const auto areas = areas_of(
      cover_streets({way({{-200, 0}, {200, 0}}, {{"highway", "residential"}}),
                     way({{-200, 4}, {200, 4}},
                         {{"highway", "footway"}, {"width", "2"}, {"surface", "concrete"}})}),
      middle);
  EXPECT_NEAR(areas.at("concrete"), 100 * 2, 0.2);
  EXPECT_NEAR(areas.at("paving stones"), 100 * (2 * 2.5 - 2), 0.3);
}

TEST(StreetAreas, WhatLiesBelowTheGroundIsLeftOutAndWhatOnlyCrossesBelowIsNot) {
  const osm::OsmTags foot{{"highway", "footway"}};
  const auto with = [&](osm::OsmTags more) {
    more.insert(foot.begin(), foot.end());
    return way({{-200, 0}, {200, 0}}, more);
  };
  const auto count = [&](const osm::OsmWay& one) { return cover_streets({one}).areas().size(); };
  EXPECT_EQ(count(with({{"level", "-1"}})), 0u) << "a passage of a station";
  EXPECT_EQ(count(with({{"level", "-2;-1"}})), 0u);
  EXPECT_EQ(count(with({{"level", "-1-0"}})), 1u) << "a range that is not read";
  EXPECT_EQ(count(with({{"layer", "-1"}, {"covered", "yes"}})), 0u);
  EXPECT_EQ(count(with({{"level", "-1;0"}})), 1u) << "it comes up to the street";
  EXPECT_EQ(count(with({{"layer", "-1"}})), 1u) << "an open cutting below a bridge";
  EXPECT_EQ(count(with({{"layer", "-1"}, {"covered", "no"}})), 1u);
  EXPECT_EQ(count(with({{"level", "nonsense"}})), 1u);
}

TEST(StreetAreas, TunnelsAreLeftOutAndCounted) {
  const Cover cover = cover_streets(
      {way({{-200, 0}, {200, 0}}, {{"highway", "primary"}, {"tunnel", "yes"}}),
       way({{-200, 9}, {200, 9}}, {{"highway", "service"}, {"tunnel", "building_passage"}})});
  EXPECT_EQ(cover.left_out.at("street in a tunnel or a building"), 1u);
  EXPECT_EQ(cover.areas().size(), 3u) << "a carriageway and its ends";
}

TEST(StreetAreas, ValuesWithoutATagAreCounted) {
  const Cover cover =
      cover_streets({way({{-200, 0}, {200, 0}}, {{"highway", "residential"}}),
                     way({{-200, 9}, {200, 9}}, {{"highway", "footway"}, {"surface", "asphalt"}})});
  EXPECT_EQ(cover.assumed.at("surface of a street"), 1u);
  EXPECT_EQ(cover.assumed.at("pavement beside a street"), 1u);
}

TEST(StreetAreas, LivingStreetsAreLevel) {
  EXPECT_EQ(
      areas_of(cover_streets({way({{-200, 0}, {200, 0}}, {{"highway", "living_street"}})}), middle)
          .count("sunken"),
      0u);
}

TEST(StreetAreas, WaysOutsideTheGroundCostNothing) {
  EXPECT_TRUE(cover_streets({way({{-900, 900}, {900, 900}}, {{"highway", "primary"}})}).empty());
}

TEST(StreetAreas, AMarkedCrossingHasBarsOnTheCarriagewayOnly) {
  // 20 m across a street of 6.5 m: ten bars and ten gaps a metre apart, 4 m long.
  const auto areas = areas_of(
      cover_streets({way({{-200, 0}, {200, 0}}, {{"highway", "primary"}, {"lane_markings", "no"}}),
                     way({{0, -10}, {0, 10}},
                         {{"highway", "footway"}, {"footway", "crossing"}, {"crossing", "zebra"}})},
                    true),
      middle);
  EXPECT_NEAR(areas.at("paint"), 6.5 * 4 / 2, 1.01);  // a bar may lie astride the kerb
}

TEST(StreetAreas, LanesArePartedByDashes) {
  const auto areas = areas_of(
      cover_streets({way({{-200, 0}, {200, 0}}, {{"highway", "primary"}, {"lanes", "4"}})}, true),
      middle);
  // Three lines, a third of whose length is painted.
  EXPECT_NEAR(areas.at("paint"), 3 * 0.12 * 100 / 3, 3 * 0.12 * 3);
  EXPECT_EQ(
      areas_of(cover_streets({way({{-200, 0}, {200, 0}}, {{"highway", "residential"}})}, true),
               middle)
          .count("paint"),
      0u);
}

// Paint south and north of the middle of a street of two lanes of 3 m that runs eastwards and
// crosses another at x = 100, and how it lies along it.
struct Paint {
  double south_m2 = 0, north_m2 = 0, west_m = 1e9, east_m = -1e9;
};

Paint find_paint(const osm::OsmPoint& control, osm::OsmTags more = {}, bool on_the_left = false) {
  more.insert({{"highway", "tertiary"}, {"lane_markings", "no"}});
  const Cover cover = cover_streets({way({{-200, 0}, {80, 0}, {100, 0}, {300, 0}}, std::move(more)),
                                     way({{100, -100}, {100, 0}, {100, 100}},
                                         {{"highway", "tertiary"}, {"lane_markings", "no"}})},
                                    true, {control}, on_the_left);
  const CoverPart part = cover.find_part(bounds, {0, 0});
  Paint paint;
  for (const mesh::PlaneArea& area : part.markings)
    for (const Ring& ring : area.rings) {
      const double m2 = std::abs(signed_area(ring));
      glm::dvec2 middle(0);
      for (const glm::dvec2& p : ring) {
        middle += p / static_cast<double>(ring.size());
        paint.west_m = std::min(paint.west_m, p.x);
        paint.east_m = std::max(paint.east_m, p.x);
      }
      (middle.y < 0 ? paint.south_m2 : paint.north_m2) += m2;
    }
  return paint;
}

osm::OsmPoint stop(osm::OsmTags more = {}) {
  more.insert({"highway", "stop"});
  return {{80, 0}, std::move(more)};
}

TEST(StreetAreas, AStopLineLiesAcrossTheLanesThatFaceTheJunction) {
  const Paint right = find_paint(stop()), left = find_paint(stop(), {}, true);
  EXPECT_NEAR(right.south_m2, 3 * 0.5, 0.02);
  EXPECT_EQ(right.north_m2, 0);
  EXPECT_NEAR(right.west_m, 79.5, 0.01);
  EXPECT_NEAR(right.east_m, 80, 0.01);
  EXPECT_NEAR(left.north_m2, 3 * 0.5, 0.02);
  EXPECT_EQ(left.south_m2, 0);
}

TEST(StreetAreas, TheTagDirectionDecidesWhichLanesAStopLineIsFor) {
  const Paint back = find_paint(stop({{"direction", "backward"}}));
  EXPECT_NEAR(back.north_m2, 3 * 0.5, 0.02);
  EXPECT_EQ(back.south_m2, 0);
  EXPECT_NEAR(back.west_m, 80, 0.01);
  const Paint both = find_paint(stop({{"direction", "both"}}));
  EXPECT_NEAR(both.north_m2 + both.south_m2, 2 * 3 * 0.5, 0.02);
  const Paint signal = find_paint(
      {{80, 0}, {{"highway", "traffic_signals"}, {"traffic_signals:direction", "forward"}}});
  EXPECT_NEAR(signal.south_m2, 3 * 0.5, 0.02);
}

TEST(StreetAreas, AOneWayStreetHasItsStopLineFromKerbToKerb) {
  const Paint paint = find_paint(stop(), {{"oneway", "yes"}, {"lanes", "2"}});
  EXPECT_NEAR(paint.south_m2 + paint.north_m2, 6 * 0.5, 0.02);
}

TEST(StreetAreas, ALineAtWhichToGiveWayIsBroken) {
  const Paint paint = find_paint({{80, 0}, {{"highway", "give_way"}}});
  EXPECT_NEAR(paint.south_m2, 4 * 0.5 * 0.5, 0.02);  // 3 m hold four dashes
}

TEST(StreetAreas, AStopLineLiesBeforeTheCrossingOfItsSignal) {
  const Paint paint = find_paint({{80, 0},
                                  {{"highway", "traffic_signals"},
                                   {"crossing", "traffic_signals"},
                                   {"direction", "forward"}}});
  EXPECT_NEAR(paint.east_m, 80 - 3, 0.01);  // half a crossing of 4 m, and 1 m
}

TEST(StreetAreas, StopLinesThatNothingPlacesAreCounted) {
  const auto left_out = [](const osm::OsmPoint& control) {
    return cover_streets({way({{-200, 0}, {0, 0}, {200, 0}}, {{"highway", "residential"}}),
                          way({{0, -200}, {0, 0}, {0, 200}}, {{"highway", "residential"}}),
                          way({{-200, 90}, {0, 90}, {200, 90}}, {{"highway", "residential"}})},
                         true, {control});
  };
  EXPECT_EQ(left_out({{0, 0}, {{"highway", "traffic_signals"}}})
                .left_out.at("stop line of a sign in the middle of a junction"),
            2u);
  EXPECT_EQ(left_out({{0, 90}, {{"highway", "stop"}}})
                .left_out.at("stop line whose direction nothing says"),
            1u);
  EXPECT_EQ(left_out({{0, 90}, {{"highway", "traffic_signals"}}}).markings.at("stop line"), 2u)
      << "a signal away from junctions is for people who cross";
}

TEST(StreetAreas, HostileWaysEndWithACount) {
  const double nan = std::nan("");
  const Cover cover = cover_streets(
      {way({{nan, nan}, {nan, nan}}, {{"highway", "primary"}}),
       way({{0, 0}, {0, 0}}, {{"highway", "primary"}}),
       way({{-1e9, 0}, {1e9, 0}, {0, 1e9}}, {{"highway", "primary"}, {"sidewalk", "no"}}),
       way({{0, 0}, {10, 0}, {0, 0}, {10, 0}, {5, 5}, {5, -5}}, {{"highway", "footway"}})},
      true, {{{nan, nan}, {{"highway", "stop"}}}, {{0, 0}, {{"highway", "stop"}}}});
  EXPECT_GE(cover.left_out.size(), 1u);
  areas_of(cover, middle);
}

TEST(StreetAreas, StreetsOnEmbankmentsLieOnTheGroundAndAreCounted) {
  Cover cover;
  const std::vector<osm::OsmWay> ways{
      way({{-100, 0}, {100, 0}}, {{"highway", "primary"}, {"embankment", "yes"}}),
      way({{-600, 90}, {100, 90}}, {{"highway", "primary"}, {"cutting", "left"}}),
      way({{-100, -90}, {100, -90}}, {{"highway", "primary"}, {"cutting", "no"}})};
  add_streets(ways, true, as_metres, bounds, cover);
  EXPECT_NEAR(cover.left_out_m.at("slopes of a street with embankment"), 200, 1e-9);
  EXPECT_NEAR(cover.left_out_m.at("slopes of a street with cutting"), 600, 1e-9);
}

}  // namespace
}  // namespace nightcity::ground_cover
