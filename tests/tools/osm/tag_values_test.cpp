#include "tools/osm/tag_values.h"

#include <gtest/gtest.h>

#include <utility>

namespace nightcity::osm {
namespace {

TEST(TagValues, LengthsInEveryUnitAndSpelling) {
  const struct {
    const char* text;
    double metres;
  } known[] = {{"6", 6},         {"6 m", 6},      {"6m", 6},        {" 6.5 m ", 6.5},
               {"6,5", 6.5},     {"20'", 6.096},  {"20 ft", 6.096}, {"20ft", 6.096},
               {"12'6\"", 3.81}, {"600 cm", 6},   {"~6 m", 6},      {"6;8", 6},
               {"5-7", 6},       {"5-7 m", 6},    {"6 meters", 6},  {"6 Metres", 6},
               {"ca. 6 m", 6},   {"4 m; 5 m", 4}, {"8 mts.", 8}};
  for (const auto& [text, metres] : known) {
    const auto length = parse_length_m(text);
    ASSERT_TRUE(length) << text;
    EXPECT_NEAR(*length, metres, 1e-9) << text;
  }
  for (const char* text : {"", "m", "tall", "6 miles", "6 storeys", ";", "1e400", "--6", "0x10"})
    EXPECT_FALSE(parse_length_m(text)) << text;
}

TEST(TagValues, TagsAsWrittenAndNormalised) {
  const OsmTags tags{
      {"name", " Am Hof "}, {"leisure", "Sports-Centre"}, {"bridge", "No"}, {"a", ""}};
  EXPECT_EQ(find_raw_tag(tags, "name"), " Am Hof ");
  EXPECT_EQ(find_raw_tag(tags, "none"), "");
  EXPECT_EQ(find_tag(tags, "leisure"), "sports_centre");
  EXPECT_EQ(find_tag(tags, "none"), "");
  EXPECT_TRUE(is_tagged(tags, "leisure"));
  for (const char* key : {"bridge", "a", "none"}) EXPECT_FALSE(is_tagged(tags, key)) << key;
}

TEST(TagValues, LengthsInInchesYardsTypographyAndAboutRight) {
  const std::pair<const char*, double> known[] = {{"120 in", 3.048},
                                                  {"120\"", 3.048},
                                                  {"12 ft 6 in", 3.81},
                                                  {"12ft6in", 3.81},
                                                  {"12\xe2\x80\xb2", 3.6576},
                                                  {"12\xe2\x80\xb2 6\xe2\x80\xb3", 3.81},
                                                  {"12\xe2\x80\x99", 3.6576},
                                                  {"4 yd", 3.6576},
                                                  {"0.01 km", 10},
                                                  {"6\xc2\xa0m", 6},
                                                  {"+6", 6},
                                                  {"approx. 6 m", 6},
                                                  {"about 6", 6},
                                                  {"\xe2\x89\x88 6 m", 6},
                                                  {"5\xe2\x80\x93"
                                                   "7 m",
                                                   6},
                                                  {"6 mts", 6},
                                                  {"32'-6\"", 9.906},
                                                  {"6 \xd0\x9c", 6},
                                                  {"6 \xd0\xbc", 6}};
  for (const auto& [text, metres] : known) {
    const auto length = parse_length_m(text);
    ASSERT_TRUE(length) << text;
    EXPECT_NEAR(*length, metres, 1e-9) << text;
  }
  for (const char* text : {"12'6 m", "12 in 6 ft", "about", "12 ft tall"})
    EXPECT_FALSE(parse_length_m(text)) << text;
}

TEST(TagValues, ThousandsOfLumensAndWattsMayBeSeparated) {
  const std::pair<const char*, double> fluxes[] = {{"12,000 lm", 12000},
                                                   {"12.000", 12000},
                                                   {"12 000 lm", 12000},
                                                   {"12\xc2\xa0"
                                                    "000",
                                                    12000},
                                                   {"12'000", 12000},
                                                   {"4500lm", 4500},
                                                   {"4.5 klm", 4500},
                                                   {"4.500 klm", 4500},
                                                   {"850.125", 850.125},
                                                   {"1,234.5", 1234.5},
                                                   {"4500.5", 4500.5},
                                                   {"1.250.000", 1250000}};
  for (const auto& [text, lumens] : fluxes) EXPECT_EQ(parse_lumens(text), lumens) << text;
  const std::pair<const char*, double> powers[] = {{"1,000 W", 1000},
                                                   {"70.000", 70},
                                                   {"70,5 W", 70.5},
                                                   {"0.25 kW", 250},
                                                   {"2.000", 2000},
                                                   {"2x36 W", 72},
                                                   {"2 x 36", 72},
                                                   {"4*18W", 72},
                                                   {"2\xc3\x97"
                                                    "58 W",
                                                    116},
                                                   {"1x70W", 70}};
  for (const auto& [text, watts] : powers) EXPECT_EQ(parse_watts(text), watts) << text;
  for (const char* text : {"2x", "2x2x36", "36x2000x", "0x36", "2 36 W", "2xx36"})
    EXPECT_FALSE(parse_watts(text)) << text;
  for (const char* text : {"", "lm", "12,000 W", "12 00 lm", "2 x 3000 lm", "3000/6000"})
    EXPECT_FALSE(parse_lumens(text)) << text;
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

TEST(TagValues, UnitsOfOtherLanguagesAndRemarks) {
  for (const char* twelve : {"12 mètres", "12 метров", "12米", "12公尺", "１２", "12 m (39 ft)",
                             "12\xe2\x80\x8b m", "12 metrów", "12 メートル"})
    EXPECT_EQ(parse_length_m(twelve), 12) << twelve;
  EXPECT_EQ(parse_length_m("\xe2\x88\x92"
                           "3"),
            -3);  // the minus of typography
  EXPECT_FALSE(parse_length_m("12 parsecs (far)"));
  EXPECT_EQ(to_plain_signs("−０．５；Ａ\xe2\x80\x8e"), "-0.5;A");
  EXPECT_EQ(parse_watts("36 Вт"), 36);
}

TEST(TagValues, RangesWithUnitsThousandsOfFeetAndWordsForAbout) {
  const struct {
    const char* text;
    double metres;
  } cases[] = {
      {"3.5m-4m", 3.75},         {"3.0m～5.5m", 4.25}, {"3〜5 m", 4},        {"3.0 m - 5 m", 4},
      {"10 ft - 12 ft", 3.3528}, {"12'-6\"", 3.81},    {"1,200 ft", 365.76}, {"1,200'", 365.76},
      {"1,200 m", 1.2},          {"1,20 ft", 0.36576}, {"6 to 8 m", 7},      {"6 a 8 m", 7},
      {"22 to 26 ft", 7.3152},   {"W=6.0m", 6},        {"約12m", 12},        {"aprox. 12 m", 12},
      {"cerca de 12 m", 12},     {"około 12 m", 12}};
  for (const auto& [text, metres] : cases)
    EXPECT_NEAR(parse_length_m(text).value_or(-1), metres, 1e-9) << text;
  EXPECT_FALSE(parse_length_m("3 m - x"));
}

}  // namespace
}  // namespace nightcity::osm
