#include "tools/inventory/degrees_text.h"

#include <gtest/gtest.h>

#include <utility>

namespace nightcity::inventory {
namespace {

constexpr double lat = 52 + 31 / 60.0 + 12.5 / 3600, lon = 13 + 24 / 60.0 + 18 / 3600.0;

TEST(DegreesText, AnglesInEverySpelling) {
  const std::pair<const char*, double> known[] = {{"52\u00b031'12.5\"N", lat},
                                                  {"52\u00b031\u203212.5\u2033 N", lat},
                                                  {"52\u00b0 31\u2019 12,5\u201d", lat},
                                                  {"52\u00ba31'12.5''N", lat},
                                                  {"52d31m12.5s", lat},
                                                  {"52 31 12.5", lat},
                                                  {"52:31:12.5", lat},
                                                  {"N 52\u00b031'12.5\"", lat},
                                                  {"N52 31.2083333333333333", lat},
                                                  {"52deg 31' 12.5\"", lat},
                                                  {"S52\u00b031'12.5\"", -lat},
                                                  {"-52\u00b031'12.5\"", -lat},
                                                  {"+52.5", 52.5},
                                                  {"13.5W", -13.5},
                                                  {"13,5\u00b0 w", -13.5},
                                                  {"0\u00b000'00\"E", 0},
                                                  {"180\u00b0W", -180},
                                                  {"-0\u00b030'", -0.5},
                                                  {"359.5", 359.5}};
  for (const auto& [text, degrees] : known) {
    const auto angle = parse_angle(text);
    ASSERT_TRUE(angle) << text;
    EXPECT_NEAR(angle->degrees, degrees, 1e-9) << text;
  }
  for (const char* text : {"", "N", "52\u00b060'", "52\u00b031'60\"", "52.5\u00b031'", "95N", "361",
                           "13\u00b0O", "-52N", "52 31 12 5", "52\u00b031'12.5\"NE", "1e2", "nan",
                           "52-31-12", "52\u00b0-31'", "N52N"})
    EXPECT_FALSE(parse_angle(text)) << text;
}

TEST(DegreesText, PlacesInEverySpelling) {
  for (const char* text :
       {"52\u00b031'12.5\"N 13\u00b024'18\"E", "13\u00b024'18\"E, 52\u00b031'12.5\"N",
        "N52\u00b031'12.5\" E13\u00b024'18\"", "52 31 12.5; 13 24 18", "52:31:12.5, 13:24:18",
        "(52\u00b031'12,5\"N / 13\u00b024'18,0\"E)", "52\u00b031'12.5\"N13\u00b024'18\"E",
        "52.5201388888889, 13.405", "52,5201388888889, 13,405", "[52.5201388888889,13.405]"}) {
    const auto place = parse_lat_lon(text);
    ASSERT_TRUE(place) << text;
    EXPECT_NEAR(place->x, lon, 1e-9) << text;
    EXPECT_NEAR(place->y, lat, 1e-9) << text;
  }
  for (const char* text : {"", ",", "52.5", "52N, 13N", "13E 14E", "a, b", "52;13;14", "Berlin"})
    EXPECT_FALSE(parse_lat_lon(text)) << text;
}

}  // namespace
}  // namespace nightcity::inventory
