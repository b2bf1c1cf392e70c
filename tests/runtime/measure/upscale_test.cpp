#include "runtime/measure/upscale.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace nightcity::measure {
namespace {

Image make_ramp(std::uint32_t width, std::uint32_t height) {
  Image image;
  image.width = width;
  image.height = height;
  ImageLayer feature{"feature", {"I"}, {}}, sky{"sky", {"R", "G", "B"}, {}};
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x) {
      for (const float value : {float(x) + 0.5f, float(y) + 0.5f, 7.0f}) {
        image.rgb.push_back(value);
        sky.values.push_back(value);
      }
      feature.values.push_back(float(10 * y + x));
    }
  image.layers = {feature, sky};
  image.info.estimator = "ris";
  return image;
}

TEST(Upscale, IsBilinearBetweenCentresAndFlatAtTheBorder) {
  const Image large = upscale(make_ramp(4, 2), 8, 4);
  ASSERT_EQ(large.rgb.size(), 3u * 32);
  EXPECT_EQ(large.info.estimator, "ris");
  for (std::uint32_t y = 0; y < 4; ++y)
    for (std::uint32_t x = 0; x < 8; ++x) {
      const float* rgb = &large.rgb[3 * (8 * y + x)];
      EXPECT_FLOAT_EQ(rgb[0], std::clamp((float(x) + 0.5f) / 2, 0.5f, 3.5f));
      EXPECT_FLOAT_EQ(rgb[1], std::clamp((float(y) + 0.5f) / 2, 0.5f, 1.5f));
      EXPECT_FLOAT_EQ(rgb[2], 7);
    }
  EXPECT_EQ(large.layer("sky")->values, large.rgb) << "light is mixed in layers, too";
}

TEST(Upscale, NumbersAreThoseOfThePixelItself) {
  const Image large = upscale(make_ramp(3, 2), 6, 4);
  for (std::uint32_t y = 0; y < 4; ++y)
    for (std::uint32_t x = 0; x < 6; ++x)
      EXPECT_EQ(large.layer("feature")->values[6 * y + x], float(10 * (y / 2) + x / 2));
}

TEST(Upscale, ToItsOwnSizeChangesNothing) {
  const Image image = make_ramp(5, 3);
  EXPECT_EQ(upscale(image, 5, 3).rgb, image.rgb);
  EXPECT_EQ(upscale(make_ramp(1, 1), 3, 2).rgb.size(), 18u);
}

}  // namespace
}  // namespace nightcity::measure
