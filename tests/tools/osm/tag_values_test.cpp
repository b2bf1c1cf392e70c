#include "tools/osm/tag_values.h"

#include <gtest/gtest.h>

namespace nightcity::osm {
namespace {

TEST(TagValues, LengthsInEveryUnitAndSpelling) {
  const struct {
    const char* text;
    double metres;
  } known[] = {{"6", 6},         {"6 m", 6},     {"6m", 6},        {" 6.5 m ", 6.5},
               {"6,5", 6.5},     {"20'", 6.096}, {"20 ft", 6.096}, {"20ft", 6.096},
               {"12'6\"", 3.81}, {"600 cm", 6},  {"~6 m", 6},      {"6;8", 6},
               {"5-7", 6},       {"5-7 m", 6},   {"6 meters", 6},  {"6 Metres", 6},
               {"ca. 6 m", 6},   {"4 m; 5 m", 4}};
  for (const auto& [text, metres] : known) {
    const auto length = parse_length_m(text);
    ASSERT_TRUE(length) << text;
    EXPECT_NEAR(*length, metres, 1e-9) << text;
  }
  for (const char* text : {"", "m", "tall", "6 miles", "6 storeys", ";", "1e400", "--6", "0x10"})
    EXPECT_FALSE(parse_length_m(text)) << text;
}

TEST(TagValues, CaseBlanksAndHyphensDoNotMatter) {
  EXPECT_EQ(normalise_tag(" High-Pressure Sodium\t"), "high_pressure_sodium");
}

TEST(TagValues, ListsWithoutBlanksAndEmptyParts) {
  EXPECT_EQ(split_list(" a;b c ;; d"), (std::vector<std::string_view>{"a", "b c", "d"}));
  EXPECT_TRUE(split_list(" ; ").empty());
}

TEST(TagValues, NumbersAreTakenOffTheFront) {
  std::string_view text = " 6,5 m";
  EXPECT_EQ(take_number(text), 6.5);
  EXPECT_EQ(text, "m");
  EXPECT_FALSE(take_number(text));
  EXPECT_EQ(text, "m");
}

}  // namespace
}  // namespace nightcity::osm
