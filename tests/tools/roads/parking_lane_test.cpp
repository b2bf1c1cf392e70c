#include "tools/roads/parking_lane.h"

#include <gtest/gtest.h>

namespace nightcity::roads {
namespace {

std::string name_at(const osm::OsmTags& tags, const char* side = "right") {
  const auto lane = read_parking_lane(tags, side);
  return lane ? lane->name() : "";
}

TEST(ParkingLane, TheNewSchemeSaysWhereAndHow) {
  EXPECT_EQ(name_at({{"parking:right", "lane"}, {"parking:right:orientation", "parallel"}}),
            "lane, parallel");
  EXPECT_EQ(name_at({{"parking:both", "street_side"}, {"parking:both:orientation", "diagonal"}}),
            "street side, diagonal");
  EXPECT_EQ(name_at({{"parking:right", "half_on_kerb"}}), "half on kerb, parallel");
  EXPECT_EQ(name_at({{"parking:right", "on_kerb"}, {"parking:right:orientation", "perpendicular"}}),
            "on kerb, perpendicular");
  EXPECT_EQ(name_at({{"parking:left", "lane"}}), "");
  for (const char* nothing : {"no", "separate", "nonsense", ""})
    EXPECT_EQ(name_at({{"parking:both", nothing}}), "") << nothing;
  EXPECT_TRUE(is_parking_separate({{"parking:left", "separate"}}, "left"));
  EXPECT_FALSE(is_parking_separate({{"parking:left", "separate"}}, "right"));
}

TEST(ParkingLane, TheOlderSchemeSaysHowAndWhere) {
  EXPECT_EQ(name_at({{"parking:lane:right", "parallel"}}), "lane, parallel");
  EXPECT_EQ(name_at({{"parking:lane:both", "perpendicular"},
                     {"parking:lane:both:perpendicular", "street_side"}}),
            "street side, perpendicular");
  EXPECT_EQ(
      name_at({{"parking:lane:right", "diagonal"}, {"parking:lane:right:diagonal", "on_kerb"}}),
      "on kerb, diagonal");
  EXPECT_EQ(
      name_at({{"parking:lane:both", "parallel"}, {"parking:lane:both:inline", "half_on_kerb"}}),
      "half on kerb, parallel");
  EXPECT_EQ(
      name_at({{"parking:lane:right", "parallel"}, {"parking:lane:right:parallel", "lay_by"}}),
      "street side, parallel");
  EXPECT_TRUE(read_parking_lane({{"parking:lane:left", "marked"}}, "left")->marked);
  for (const char* nothing :
       {"no", "no_parking", "no_stopping", "fire_lane", "separate", "nonsense"})
    EXPECT_EQ(name_at({{"parking:lane:both", nothing}}), "") << nothing;
}

TEST(ParkingLane, TheNewSchemeCountsBeforeTheOlderOne) {
  EXPECT_EQ(name_at({{"parking:right", "no"}, {"parking:lane:right", "parallel"}}), "");
  EXPECT_EQ(name_at({{"parking:both", "street_side"}, {"parking:lane:right", "parallel"}}),
            "street side, parallel");
}

TEST(ParkingLane, OrientationThatNobodySaysIsAssumed) {
  EXPECT_TRUE(read_parking_lane({{"parking:both", "lane"}}, "left")->orientation_assumed);
  EXPECT_FALSE(read_parking_lane({{"parking:lane:both", "parallel"}}, "left")->orientation_assumed);
}

TEST(ParkingLane, BaysAreAsDeepAsTheirOrientationOrTheirWidthSays) {
  const auto depth_m = [](osm::OsmTags tags) {
    tags.emplace("parking:right", "street_side");
    return read_parking_lane(tags, "right")->beyond_edge_m();
  };
  EXPECT_EQ(depth_m({}), 2.00);
  EXPECT_EQ(depth_m({{"parking:right:orientation", "diagonal"}}), 4.60);
  EXPECT_EQ(depth_m({{"parking:right:orientation", "perpendicular"}}), 4.30);
  EXPECT_EQ(depth_m({{"parking:right:width", "2.5 m"}}), 2.5);
  for (const char* text : {"0", "-3", "1e9", "nan", "900", "wide"})
    EXPECT_EQ(depth_m({{"parking:right:width", text}}), 2.00) << text;
  EXPECT_EQ(depth_m({{"parking:right", "half_on_kerb"}}), 1.00);
  EXPECT_EQ(depth_m({{"parking:right", "lane"}}), 0);
}

TEST(ParkingLane, LiesWithinTheCarriagewayAndBeyondItAsItsPlaceSays) {
  for (const auto& [place, within_m] :
       {std::pair{"lane", 2.0}, {"half_on_kerb", 1.0}, {"on_kerb", 0.0}, {"street_side", 0.0}}) {
    const auto lane = read_parking_lane({{"parking:both", place}}, "left");
    EXPECT_EQ(lane->within_edge_m(), within_m) << place;
    EXPECT_EQ(lane->within_edge_m() + lane->beyond_edge_m(), lane->bay().depth_m) << place;
  }
}

}  // namespace
}  // namespace nightcity::roads
