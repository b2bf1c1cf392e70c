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

}  // namespace
}  // namespace nightcity::map_buildings
