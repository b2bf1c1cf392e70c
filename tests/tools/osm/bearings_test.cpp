#include "tools/osm/bearings.h"

#include <gtest/gtest.h>

namespace nightcity::osm {
namespace {

TEST(Bearings, DegreesCompassPointsAndRanges) {
  const std::pair<const char*, double> known[] = {
      {"90", 90},          {"NNE", 22.5},
      {"south-west", 225}, {"SouthWest", 225},
      {"-90", 270},        {"360", 0},
      {"-360", 0},         {"22,5", 22.5},
      {"45\xc2\xb0", 45},  {" 45 degrees ", 45},
      {"45-100", 72.5},    {"350-10", 0},
      {"-45-45", 0},       {"NW-NE", 0},
      {"N-E", 45},         {"NNW \xe2\x80\x93 NE", 11.25}};
  for (const auto& [text, degrees] : known) {
    const auto bearing = parse_bearing_degrees(text);
    ASSERT_TRUE(bearing) << text;
    EXPECT_NEAR(*bearing, degrees, 1e-9) << text;
  }
  for (const char* text : {"", "-", "forward", "720", "90 apples", "N-W", "N-S", "90-270", "0-360",
                           "45-", "both", "nan", "1e400"})
    EXPECT_FALSE(parse_bearing_degrees(text)) << text;
}

TEST(Bearings, ListsInEverySpelling) {
  for (const char* text : {"90;270", "90,270", "90, 270", "90 / 270", "E;W", "E/W", "E,W", "90|270",
                           "90 & 270", " 90 ;; 270; ", "90\xc2\xb0;270\xc2\xb0", "-270;-90"})
    EXPECT_EQ(parse_bearings(text).degrees, (std::vector<double>{90, 270})) << text;
  EXPECT_EQ(parse_bearings("0,120,240").degrees, (std::vector<double>{0, 120, 240}));
  EXPECT_EQ(parse_bearings("22,5;202,5").degrees, (std::vector<double>{22.5, 202.5}));
  EXPECT_EQ(parse_bearings("0,5,9").degrees, (std::vector<double>{0, 5, 9}));
  const Bearings half = parse_bearings("90;left");
  EXPECT_EQ(half.degrees, std::vector<double>{90});
  EXPECT_EQ(half.unread, std::vector<std::string>{"left"});
  EXPECT_TRUE(parse_bearings("").degrees.empty());
}

}  // namespace
}  // namespace nightcity::osm
