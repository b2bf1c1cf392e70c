#include "runtime/render/parse.h"

#include <gtest/gtest.h>

#include "formats/error.h"

namespace nightcity::render {
namespace {

TEST(Parse, TimesCountFromNoon) {
  EXPECT_EQ(parse_time("12:00"), 0);
  EXPECT_EQ(parse_time("20:30"), 8.5 * 3600);
  EXPECT_EQ(parse_time("0:01:02.5"), 12 * 3600 + 62.5);
  for (const char* text : {"", "20", "24:00", "20:60", "20:00:60", "20:00:nan", "20:00:00:00",
                           "20:0x", "-1:00", "020:00", " 9:00", "+9:00", "20:+5", "20: 5",
                           "20:00: 5", "20:00:+5", "20:00:-0", "20:00 ", "20:00:5 "})
    EXPECT_THROW(parse_time(text), UsageError) << text;
}

TEST(Parse, SizesAreTwoSidesOfBoundedLength) {
  const PictureSize size = parse_size("640x360");
  EXPECT_EQ(size.width, 640u);
  EXPECT_EQ(size.height, 360u);
  for (const char* text :
       {"", "640", "x", "0x1", "1x0", "32769x1", "1x1x1", "640X360", "-1x1", " 16x9", "16 x9",
        "16x 9", "16x9 ", "+16x9", "16x+9", "0x10x9", "1e2x9", "16.0x9", "4294967297x1"})
    EXPECT_THROW(parse_size(text), UsageError) << text;
}

TEST(Parse, MoonsHaveAnOptionalIlluminance) {
  EXPECT_EQ(parse_moon("160,35").lux, 0.25);
  const MoonPosition moon = parse_moon("-10, 90,1.5");
  EXPECT_EQ(moon.azimuth_deg, -10);
  EXPECT_EQ(moon.elevation_deg, 90);
  EXPECT_EQ(moon.lux, 1.5);
  for (const char* text :
       {"", "160", "160,0", "160,91", "361,35", "160,35,0", "160,35,", "nan,35", "160,nan",
        "160,35,nan", "1,2,3,4", " 160,35", "160 ,35", "160,35 ", "160,+-35", "0x10,35"})
    EXPECT_THROW(parse_moon(text), UsageError) << text;
}

TEST(Parse, ListsHaveNoEmptyWord) {
  EXPECT_EQ(split_list("--a", "1,b"), (std::vector<std::string>{"1", "b"}));
  EXPECT_EQ(parse_counts("--a", "1,20", 1, 20), (std::vector<std::size_t>{1, 20}));
  EXPECT_THROW(split_list("--a", "1,,2"), UsageError);
  EXPECT_THROW(split_list("--a", ""), UsageError);
  EXPECT_EQ(parse_counts("--a", "1, 20", 1, 20), (std::vector<std::size_t>{1, 20}));
  for (const char* text : {"1,21", " 1,2", "1 ,2", "1,2 ", "1,+2", "1,-2", "1,2.0", "1,0x2", "1, "})
    EXPECT_THROW(parse_counts("--a", text, 1, 20), UsageError) << text;
}

TEST(Parse, NumbersAreWholeWordsInRange) {
  EXPECT_EQ(parse_number("--a", "+0.5", 0, 1), 0.5);
  for (const char* text : {"", "nan", "inf", "1.1", "-0.1", "0.5 ", " 0.5", "0,5", "+", "+-0.5",
                           "++0.5", "0x1p-1", "half"})
    EXPECT_THROW(parse_number("--a", text, 0, 1), UsageError) << text;
  EXPECT_TRUE(parse_yes_or_no("--a", "yes"));
  EXPECT_THROW(parse_yes_or_no("--a", "1"), UsageError);
}

}  // namespace
}  // namespace nightcity::render
