// Colours against published chromaticities.
#include "formats/colour.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace nightcity {
namespace {

double luminance(const glm::vec3& rgb) {
  return 0.2126 * rgb.r + 0.7152 * rgb.g + 0.0722 * rgb.b;
}

TEST(Colour, PlanckianLocusPassesThroughPublishedPoints) {
  // CIE standard illuminant A is a black body at 2856 K; the others from integrating Planck's
  // law (CIE 15:2004).
  const struct {
    double kelvin, x, y;
  } points[] = {{2856, 0.4476, 0.4075},
                {2000, 0.5267, 0.4133},
                {4000, 0.3805, 0.3768},
                {6500, 0.3135, 0.3237}};
  for (const auto& point : points) {
    const glm::dvec2 xy = planckian_xy(point.kelvin);
    EXPECT_NEAR(xy.x, point.x, 5e-4) << point.kelvin;
    EXPECT_NEAR(xy.y, point.y, 5e-4) << point.kelvin;
  }
  EXPECT_EQ(planckian_xy(100), planckian_xy(1000));
}

TEST(Colour, EveryColourHasLuminanceOneAndNoNegativeChannel) {
  for (double kelvin = 1000; kelvin <= 15000; kelvin += 250) {
    const glm::vec3 rgb = rec709_from_xy(planckian_xy(kelvin));
    EXPECT_NEAR(luminance(rgb), 1, 1e-3);
    EXPECT_GE(std::min({rgb.r, rgb.g, rgb.b}), 0);
  }
}

TEST(Colour, WhiteIsWhite) {
  const glm::vec3 d65 = rec709_from_xy({0.3127, 0.3290});
  EXPECT_NEAR(d65.r, 1, 2e-3);
  EXPECT_NEAR(d65.g, 1, 2e-3);
  EXPECT_NEAR(d65.b, 1, 2e-3);
  const glm::vec3 warm = rec709_from_xy(planckian_xy(3000)),
                  cool = rec709_from_xy(planckian_xy(4000));
  EXPECT_GT(warm.r / warm.b, cool.r / cool.b);
}

TEST(Colour, HexIsSrgb) {
  const auto grey = rec709_from_hex("#808080");
  ASSERT_TRUE(grey);
  EXPECT_NEAR(grey->r, 1, 1e-6);
  const auto red = rec709_from_hex("#ff0000");
  EXPECT_NEAR(red->r, 1 / 0.2126, 1e-3);
  for (const char* bad : {"", "#", "#12345", "#1234567", "#gg0000", "red", "#000000"})
    EXPECT_FALSE(rec709_from_hex(bad)) << bad;
}

}  // namespace
}  // namespace nightcity
