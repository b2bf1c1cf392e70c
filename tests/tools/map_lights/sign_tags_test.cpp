#include "tools/map_lights/sign_tags.h"

#include <gtest/gtest.h>

namespace nightcity::map_lights {
namespace {

SignTags read(const char* kind, osm::OsmTags tags) {
  return read_sign_tags(tags, *find_sign(kind));
}

TEST(SignTags, WhatNoTagSaysIsAsTheKindIs) {
  const SignTags box = read("poster_box", {});
  EXPECT_EQ(box.dark, "");
  EXPECT_EQ(box.sides, 2);
  EXPECT_EQ(box.width_m, 1.19);
  EXPECT_EQ(box.size, ValueSource::rule);
  EXPECT_EQ(box.shines, ValueSource::rule);
  EXPECT_NE(read("billboard", {}).dark, "");
  EXPECT_NE(read("column", {}).dark, "");
}

TEST(SignTags, LitPostersAreDimmerThanThoseThatShine) {
  const SignTags lit = read("billboard", {{"lit", "yes"}});
  const SignTags luminous = read("billboard", {{"luminous", "yes"}});
  EXPECT_EQ(lit.dark, "");
  EXPECT_EQ(lit.luminance_cd_m2, lit_poster_cd_m2);
  EXPECT_EQ(lit.shines, ValueSource::tag);
  EXPECT_GT(luminous.luminance_cd_m2, lit.luminance_cd_m2);
}

TEST(SignTags, WhatIsSaidToBeDarkIsDark) {
  EXPECT_EQ(read("poster_box", {{"lit", "no"}}).dark, "lit=no");
  EXPECT_EQ(read("screen", {{"luminous", "no"}}).dark, "luminous=no");
  EXPECT_EQ(read("sign", {{"lit", "no"}, {"luminous", "yes"}}).dark, "");
}

TEST(SignTags, TheSeasonIsThatOfItsHalfOfTheEarth) {
  const osm::OsmTags tags{{"lit", "Apr-Sep 17:00-23:00"}};
  EXPECT_EQ(read("billboard", tags).dark, "lit=no");
  EXPECT_EQ(read_sign_tags(tags, *find_sign("billboard"), lights::Half::south).dark, "");
}

TEST(SignTags, SizesAreReadAsPeopleWriteThem) {
  for (const char* size : {"4x3", "4 x 3", "4m x 3m", "4,0 x 3,0 m", "400 cm x 300 cm", "4×3"}) {
    const SignTags sign = read("screen", {{"size", size}});
    EXPECT_EQ(sign.width_m, 4) << size;
    EXPECT_EQ(sign.height_m, 3) << size;
    EXPECT_EQ(sign.size, ValueSource::tag) << size;
  }
  const SignTags totem = read("totem", {{"height", "9"}, {"min_height", "4"}, {"width", "2"}});
  EXPECT_EQ(totem.height_m, 5);
  EXPECT_EQ(totem.foot_m, 4);
  EXPECT_EQ(totem.width_m, 2);
}

TEST(SignTags, AHeightIsThatOfTheTop) {
  const SignTags high = read("screen", {{"height", "12"}});
  EXPECT_DOUBLE_EQ(high.foot_m + high.height_m, 12);
  const SignTags low = read("screen", {{"height", "1"}});
  EXPECT_DOUBLE_EQ(low.foot_m + low.height_m, 1);
  EXPECT_GT(low.foot_m, 0);
}

TEST(SignTags, NonsenseIsCountedAndChangesNothing) {
  const SignTags usual = read("screen", {});
  for (const auto& [key, value] : std::map<std::string, std::string>{{"height", "1e9"},
                                                                     {"height", "-3"},
                                                                     {"width", "1000000"},
                                                                     {"width", "nan"},
                                                                     {"size", "A1"},
                                                                     {"size", "1e9x1e9"},
                                                                     {"sides", "7"},
                                                                     {"direction", "both"},
                                                                     {"lit", "perhaps"}}) {
    const SignTags sign = read("screen", {{key, value}});
    EXPECT_EQ(sign.unread.size(), 1u) << key << "=" << value;
    EXPECT_EQ(sign.width_m, usual.width_m);
    EXPECT_EQ(sign.height_m, usual.height_m);
    EXPECT_EQ(sign.foot_m, usual.foot_m);
    EXPECT_EQ(sign.sides, usual.sides);
  }
}

TEST(SignTags, NoDefaultExceedsWhatASuburbMayHave) {
  constexpr double cie150_e2 = 400;  // cd/m2, signs (CIE 150:2017)
  for (const char* kind : {"billboard", "column", "poster_box", "screen", "sign", "totem", "board"})
    EXPECT_LE(find_sign(kind)->luminance_cd_m2, cie150_e2);
  EXPECT_EQ(find_sign("flag"), nullptr);
}

TEST(SignTags, ADigitalDisplayIsAScreen) {
  const SignTags display = read("billboard", {{"animated", "digital_display"}});
  EXPECT_EQ(display.dark, "");
  EXPECT_EQ(display.luminance_cd_m2, read("billboard", {{"luminous", "yes"}}).luminance_cd_m2);
  EXPECT_NE(read("billboard", {{"animated", "trivision_blades"}}).dark, "");
  EXPECT_NE(read("billboard", {{"animated", "screen"}, {"luminous", "no"}}).dark, "");
}

}  // namespace
}  // namespace nightcity::map_lights
