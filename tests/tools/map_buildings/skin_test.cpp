#include "tools/map_buildings/skin.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nightcity::map_buildings {
namespace {

double luminance_of(const glm::vec3& srgb) {
  const auto linear = [](double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(srgb.x) + 0.7152 * linear(srgb.y) + 0.0722 * linear(srgb.z);
}

TEST(Skin, ColoursAreAsBrightAsPaint) {
  EXPECT_NEAR(luminance_of(find_skin({{"building:colour", "white"}}, Skin::walls).value()), 0.75,
              1e-3);
  EXPECT_NEAR(luminance_of(find_skin({{"building:colour", "#808080"}}, Skin::walls).value()),
              0.75 * 0.2159, 1e-3);
  EXPECT_EQ(find_skin({{"roof:colour", "#f00"}}, Skin::roof),
            find_skin({{"roof:color", "Red"}}, Skin::roof));
}

TEST(Skin, MaterialsReflectWhatTheirSourceSays) {
  EXPECT_NEAR(luminance_of(find_skin({{"building:material", "brick"}}, Skin::walls).value()), 0.30,
              1e-3);
  EXPECT_NEAR(luminance_of(find_skin({{"roof:material", "slate"}}, Skin::roof).value()), 0.10,
              1e-3);
  // A colour says more than a material.
  EXPECT_EQ(find_skin({{"building:material", "brick"}, {"building:colour", "white"}}, Skin::walls),
            find_skin({{"building:colour", "white"}}, Skin::walls));
}

TEST(Skin, WhatIsNotKnownIsNoSkin) {
  for (const char* value : {"", "#", "#12", "#gggggg", "#12345", "colourful", "12345#"})
    EXPECT_FALSE(find_skin({{"building:colour", value}}, Skin::walls)) << value;
  EXPECT_FALSE(find_skin({{"roof:colour", "red"}}, Skin::walls));
  EXPECT_FALSE(find_skin({}, Skin::roof));
}

TEST(Skin, ColoursInListsInGermanAndOfRal) {
  const auto skin = [](const char* colour) {
    return find_skin({{"building:colour", colour}}, Skin::walls);
  };
  for (const char* red : {"#F00", "#ff0000ff", "red;white", "red|white", "red, white", "red/white",
                          "unheard of;red", "rot", "rgb(255, 0, 0)"})
    EXPECT_EQ(skin(red), skin("#FF0000")) << red;
  EXPECT_EQ(skin("wei\xc3\x9f"), skin("#FFFFFF"));
  EXPECT_EQ(skin("hellgrau"), skin("#D3D3D3"));
  EXPECT_EQ(skin("Dunkelrot"), skin("#8B0000"));
  EXPECT_EQ(skin("RAL 7016"), skin("#383E42"));
  EXPECT_EQ(skin("ral9010"), skin("#F1ECE1"));
  EXPECT_FALSE(skin("RAL 12"));
  EXPECT_FALSE(skin("/"));
}

TEST(Skin, OtherWordsForMaterialsAndTheFirstOfSeveral) {
  const auto reflectance = [](Skin skin, const char* text) {
    return luminance_of(
        find_skin({{skin == Skin::walls ? "building:material" : "roof:material", text}}, skin)
            .value());
  };
  for (const auto& [word, right] : {std::pair{"bricks", 0.30},
                                    {"brick;stone", 0.30},
                                    {"timber_framing", 0.50},
                                    {"cement_block", 0.22},
                                    {"metal_plates", 0.13},
                                    {"mirror", 0.08},
                                    {"adobe", 0.14},
                                    {"something new;concrete", 0.22}})
    EXPECT_NEAR(reflectance(Skin::walls, word), right, 1e-3) << word;
  for (const auto& [word, right] : {std::pair{"tile", 0.22},
                                    {"metal_sheet", 0.13},
                                    {"zinc", 0.13},
                                    {"asphalt_shingle", 0.13},
                                    {"bitumen", 0.13},
                                    {"eternit", 0.22},
                                    {"reed", 0.18},
                                    {"plants", 0.10},
                                    {"solar_panels", 0.08},
                                    {"clay", 0.22}})
    EXPECT_NEAR(reflectance(Skin::roof, word), right, 1e-3) << word;
}

TEST(Skin, WhatIsNotUnderstoodIsNamed) {
  EXPECT_EQ(find_unread_skins({{"building:colour", "plaid"}, {"roof:material", "cheese"}}),
            (std::vector<std::string>{"building:colour=plaid, not understood",
                                      "roof:material=cheese, not understood"}));
  EXPECT_TRUE(
      find_unread_skins({{"building:colour", "plaid"}, {"building:material", "brick"}}).empty());
  EXPECT_TRUE(find_unread_skins({{"building", "yes"}}).empty());
}

}  // namespace
}  // namespace nightcity::map_buildings
