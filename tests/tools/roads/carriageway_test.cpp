#include "tools/roads/carriageway.h"

#include <gtest/gtest.h>

#include "tools/roads/parking_lane.h"

namespace nightcity::roads {
namespace {

double width_of(const char* highway, osm::OsmTags tags = {}) {
  tags["highway"] = highway;
  return carriageway_width(tags);
}

TEST(Carriageway, UntaggedWidthsAreThoseOfTheGuidelines) {
  EXPECT_DOUBLE_EQ(width_of("motorway"), 12.0);                    // RAA, RQ 31: one carriageway
  EXPECT_DOUBLE_EQ(width_of("trunk", {{"oneway", "yes"}}), 7.75);  // RAL, RQ 21
  EXPECT_DOUBLE_EQ(width_of("primary"), 6.5);                      // RASt 06: two lanes with buses
  EXPECT_DOUBLE_EQ(width_of("primary", {{"lanes", "4"}}), 13.0);   // RASt 06: four lanes
  EXPECT_DOUBLE_EQ(width_of("primary", {{"oneway", "yes"}}), 4.25);
  EXPECT_DOUBLE_EQ(width_of("tertiary"), 6.0);
  EXPECT_DOUBLE_EQ(width_of("residential"), 5.5);
  EXPECT_DOUBLE_EQ(width_of("residential", {{"oneway", "yes"}}), 3.5);
  EXPECT_DOUBLE_EQ(width_of("motorway_link"), 6.0);  // RAA, Q 1
  EXPECT_DOUBLE_EQ(width_of("footway"), 2.5);
  EXPECT_EQ(width_of("proposed"), 0);
  EXPECT_EQ(width_of("footway", {{"footway", "crossing"}}), 0);
}

TEST(Carriageway, WidthComesFromItsTagThenTheLanesThenTheClass) {
  EXPECT_DOUBLE_EQ(width_of("residential", {{"lanes", "3"}}), 8.25);
  EXPECT_DOUBLE_EQ(width_of("primary", {{"lanes", "4"}, {"width", "15.5 m"}}), 15.5);
  EXPECT_DOUBLE_EQ(width_of("residential", {{"width", "9999"}, {"lanes", "many"}}), 5.5);
  EXPECT_DOUBLE_EQ(width_of("primary", {{"lanes:forward", "2"}, {"lanes:backward", "1"}}), 9.75);
}

TEST(Carriageway, ParkedCarsWidenItWhereNoTagGivesItsWidth) {
  const osm::OsmTags both{{"parking:both", "lane"}, {"parking:both:orientation", "parallel"}};
  EXPECT_DOUBLE_EQ(width_of("residential", both), 5.5 + 2 * 2.0);
  EXPECT_DOUBLE_EQ(width_of("residential", {{"lanes", "1"}, {"parking:left", "lane"}}), 3.5 + 2.0);
  EXPECT_DOUBLE_EQ(width_of("residential", {{"parking:lane:right", "perpendicular"}}), 5.5 + 4.3);
  EXPECT_DOUBLE_EQ(width_of("residential", {{"parking:right", "half_on_kerb"}}), 5.5 + 1.0);
  EXPECT_DOUBLE_EQ(
      width_of("residential", {{"parking:right", "lane"}, {"parking:right:width", "3"}}),
      5.5 + 3.0);
  for (const char* elsewhere : {"on_kerb", "street_side", "separate", "no"})
    EXPECT_DOUBLE_EQ(width_of("residential", {{"parking:both", elsewhere}}), 5.5) << elsewhere;
  EXPECT_DOUBLE_EQ(width_of("residential", {{"parking:both", "lane"}, {"width", "9"}}), 9);
  EXPECT_DOUBLE_EQ(width_of("footway", both), 2.5);
  EXPECT_TRUE(read_carriageway({{"highway", "residential"}, {"parking:both", "lane"}})->is_widened);
  EXPECT_FALSE(
      read_carriageway({{"highway", "residential"}, {"parking:both", "lane"}, {"width", "9"}})
          ->is_widened);
  osm::OsmTags dropped = both;
  drop_parking(dropped);
  EXPECT_TRUE(dropped.empty());
}

TEST(Carriageway, LanesLieBesideParkedCars) {
  const auto street = [](osm::OsmTags tags) {
    tags["highway"] = "residential";
    return *read_carriageway(tags);
  };
  const Carriageway right = street({{"parking:right", "lane"}});
  EXPECT_DOUBLE_EQ(right.lane_m(), 2.75);
  EXPECT_DOUBLE_EQ(right.lanes_left_m(), 1.0);
  // The lanes reach from where the cars stand to the left kerb.
  EXPECT_DOUBLE_EQ(right.lanes_left_m() + right.lane_m(), right.width_m / 2);
  EXPECT_DOUBLE_EQ(street({{"parking:both", "lane"}}).lanes_left_m(), 0);
  // A street of 6 m leaves 1.6 m beside two lanes of 2.2 m, and the sides share that.
  const Carriageway narrow = street({{"parking:both", "lane"}, {"width", "6"}});
  EXPECT_DOUBLE_EQ(narrow.lane_m(), min_lane_m);
  EXPECT_DOUBLE_EQ(narrow.parked_m[0], 0.8);
  EXPECT_DOUBLE_EQ(narrow.parked_m[1], 0.8);
  EXPECT_DOUBLE_EQ(street({{"parking:left", "lane"}, {"width", "3"}}).parked_m[0], 0);
}

TEST(Carriageway, HoldsTheLanesThatAreDrivenOn) {
  for (const RoadClass& road : road_classes())
    for (const char* oneway : {"", "yes", "no", "-1"})
      for (const char* lanes : {"", "1", "2", "3", "4", "12", "99"})
        for (const char* width : {"", "2", "3", "5.5", "12 m", "60"}) {
          const auto carriageway = read_carriageway(
              {{"highway", road.highway}, {"oneway", oneway}, {"lanes", lanes}, {"width", width}});
          ASSERT_TRUE(carriageway);
          const int driven = carriageway->lanes[0] + carriageway->lanes[1];
          EXPECT_EQ(driven == 0, road.tier == RoadTier::path);
          EXPECT_LE(driven * carriageway->lane_m(), carriageway->width_m + 1e-9)
              << road.highway << " oneway=" << oneway << " lanes=" << lanes << " width=" << width;
          if (driven > 0) {
            EXPECT_GE(carriageway->lane_m(), min_lane_m);
            EXPECT_LE(carriageway->lane_m(), max_lane_m);
          }
        }
}

TEST(Carriageway, LanesAreSharedOut) {
  const auto lanes = [](osm::OsmTags tags) {
    const auto carriageway = read_carriageway(tags);
    return std::pair(carriageway->lanes[0], carriageway->lanes[1]);
  };
  EXPECT_EQ(lanes({{"highway", "primary"}}), std::pair(1, 1));
  EXPECT_EQ(lanes({{"highway", "motorway"}}), std::pair(2, 0));
  EXPECT_EQ(lanes({{"highway", "primary"}, {"lanes", "3"}}), std::pair(1, 1));
  EXPECT_EQ(lanes({{"highway", "primary"}, {"lanes", "3"}, {"lanes:backward", "2"}}),
            std::pair(1, 2));
  EXPECT_EQ(lanes({{"highway", "residential"}, {"oneway", "-1"}}), std::pair(0, 1));
  EXPECT_EQ(lanes({{"highway", "footway"}}), std::pair(0, 0));
}

TEST(RoadClass, EveryRowIsFoundAndSlipRoadsFallBackToTheirMainClass) {
  for (const RoadClass& road : road_classes()) EXPECT_EQ(find_road_class(road.highway), &road);
  EXPECT_EQ(find_road_class("service_link"), find_road_class("service"));
  EXPECT_FALSE(find_road_class("raceway"));
  EXPECT_EQ(main_highway("primary_link"), "primary");
  for (const double width : {3.0, 5.0, 7.0, 10.0, 20.0})
    EXPECT_TRUE(find_road_class(guess_highway(width)));
}

TEST(Carriageway, WidthsUnderOtherKeysAreRead) {
  EXPECT_DOUBLE_EQ(width_of("residential", {{"est_width", "7"}}), 7);
  EXPECT_DOUBLE_EQ(width_of("residential", {{"width", "narrow"}, {"est_width", "7"}}), 7);
  EXPECT_DOUBLE_EQ(width_of("residential", {{"width", "9"}, {"est_width", "7"}}), 9);
  EXPECT_DOUBLE_EQ(width_of("residential", {{"width", "12"}, {"width:carriageway", "6.5"}}), 6.5);
  EXPECT_NEAR(width_of("residential", {{"width", "20'6\""}}), 6.2484, 1e-9);
  EXPECT_DOUBLE_EQ(width_of("residential", {{"oneway", "yes"}, {"width:lanes", "3|3.5|3"}}), 9.5);
  EXPECT_DOUBLE_EQ(
      width_of("residential", {{"width:lanes:forward", "3|3"}, {"width:lanes:backward", "3.5"}}),
      9.5);
  for (const char* text : {"3||3", "|", "3|wide", "9|9|9|9|9|9|9|9|9|9|9|9|9|9"})
    EXPECT_DOUBLE_EQ(width_of("residential", {{"oneway", "yes"}, {"width:lanes", text}}), 3.5)
        << text;
}

TEST(Carriageway, RangesOfTheMapOfJapanAreTheLastToCount) {
  EXPECT_DOUBLE_EQ(width_of("residential", {{"yh:WIDTH", "5.5m～13.0m"}}), 9.25);
  EXPECT_DOUBLE_EQ(width_of("residential", {{"yh:WIDTH", "5.5m～13.0m"}, {"width", "6"}}), 6);
}

// OSM wiki, "Key:lanes": lanes for both directions count, and turns are listed lane by lane.
TEST(Carriageway, LanesAreCountedUnderEveryKey) {
  EXPECT_DOUBLE_EQ(
      width_of("residential",
               {{"lanes:forward", "1"}, {"lanes:backward", "1"}, {"lanes:both_ways", "1"}}),
      3 * 2.75);
  EXPECT_DOUBLE_EQ(width_of("residential", {{"lanes", "3"}, {"lanes:both_ways", "1"}}), 3 * 2.75);
  EXPECT_DOUBLE_EQ(width_of("primary", {{"oneway", "yes"}, {"turn:lanes", "left|through|right"}}),
                   3 * 3.25);
  EXPECT_DOUBLE_EQ(width_of("primary", {{"turn:lanes:forward", "left|through"},
                                        {"turn:lanes:backward", "through"}}),
                   3 * 3.25);
  EXPECT_DOUBLE_EQ(width_of("residential", {{"oneway", "-1"}, {"lanes:backward", "2"}}), 5.5);
  EXPECT_DOUBLE_EQ(width_of("residential", {{"oneway", "yes"}, {"lanes:forward", "2"}}), 5.5);
  EXPECT_DOUBLE_EQ(
      width_of("residential", {{"oneway", "yes"}, {"lanes", "1"}, {"turn:lanes", "left|through"}}),
      3.5);
}

}  // namespace
}  // namespace nightcity::roads
