#include "tools/roads/carriageway.h"

#include <gtest/gtest.h>

namespace nightcity::roads {
namespace {

double width_of(const OsmTags& tags) {
  return read_carriageway(tags)->width_m;
}

TEST(Carriageway, WidthComesFromTagsThenLanesThenTheClass) {
  EXPECT_EQ(width_of({{"highway", "residential"}}), find_road_class("residential")->width_m);
  EXPECT_EQ(width_of({{"highway", "residential"}, {"lanes", "3"}}), 9);
  EXPECT_EQ(width_of({{"highway", "primary"}, {"lanes", "4"}, {"width", "15.5 m"}}), 15.5);
  EXPECT_EQ(width_of({{"highway", "residential"}, {"width", "9999"}, {"lanes", "many"}}),
            find_road_class("residential")->width_m);
}

}  // namespace
}  // namespace nightcity::roads
