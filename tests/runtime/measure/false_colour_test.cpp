#include "runtime/measure/false_colour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "formats/error.h"

namespace nightcity::measure {
namespace {

TEST(FalseColour, GrowsLighterWithTheValueAndIsBlackWithoutOne) {
  std::vector<float> values{0, -1, std::numeric_limits<float>::quiet_NaN()};
  for (float v = 0.01f; v < 200; v *= 1.5f) values.push_back(v);
  const auto width = static_cast<std::uint32_t>(values.size());
  const Image8 image = false_colour(values, width, 1, {0.01, 100, "lx"});
  EXPECT_EQ(image.height, 1 + scale_bar_height);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(image.rgb[i], 0) << i;
  double before = -1;
  for (std::size_t i = 3; i < values.size(); ++i) {
    const double grey =
        0.2126 * image.rgb[3 * i] + 0.7152 * image.rgb[3 * i + 1] + 0.0722 * image.rgb[3 * i + 2];
    EXPECT_GE(grey, before) << values[i];
    before = grey;
  }
}

TEST(FalseColour, ScaleIsWholeDecadesAroundTheValues) {
  std::vector<float> values;
  for (int i = 0; i < 1000; ++i) values.push_back(0.3f * std::pow(100.0f, float(i) / 1000));
  values.push_back(1e9f);  // one lamp seen directly must not take the scale
  const ColourScale scale = fitting_scale(values, "cd/m2");
  EXPECT_NEAR(scale.lowest, 0.1, 1e-9);
  EXPECT_NEAR(scale.highest, 100, 1e-6);
  EXPECT_GT(fitting_scale({}, "lx").highest, 0) << "a black picture has a scale too";
}

TEST(FalseColour, BarHasLettersAndTheColoursOfTheScale) {
  const std::vector<float> values(400, 1.0f);
  const Image8 image = false_colour(values, 400, 1, {0.1, 10, "lx"});
  std::size_t white = 0;
  for (std::size_t i = 3 * 400 * 20; i < image.rgb.size(); i += 3)
    white += image.rgb[i] == 255 && image.rgb[i + 1] == 255 && image.rgb[i + 2] == 255;
  EXPECT_GT(white, 60u) << "0.1 lx, 1 lx and 10 lx";
  // The middle of a scale of two decades is the colour of 1.
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(image.rgb[3 * (400 * 8 + 199) + c], image.rgb[c], 3) << c;
}

// A surface of albedo 0.5 shows E / (2 pi).
TEST(FalseColour, IlluminanceIsTheSumOfItsDirectAndIndirectParts) {
  Image image;
  image.width = image.height = 1;
  image.rgb = {1, 1, 1};
  const auto add = [&](const char* name, float value) {
    image.layers.push_back({name, {"R", "G", "B"}, {value, value, value}});
  };
  add("albedo", 0.5f);
  float luminance = 0;
  for (const char* name : {"direct_lamps", "direct_windows", "direct_vehicles", "sky", "indirect"})
    add(name, luminance += 1);
  const float lux = 2 * std::numbers::pi_v<float>;
  EXPECT_NEAR(illuminance_of(image)[0], 15 * lux, 1e-4f);
  EXPECT_NEAR(illuminance_of(image, Illumination::direct)[0], 10 * lux, 1e-4f);
  EXPECT_NEAR(illuminance_of(image, Illumination::indirect)[0], 5 * lux, 1e-4f);
}

TEST(FalseColour, IlluminanceNeedsItsLayers) {
  Image image;
  image.width = image.height = 1;
  image.rgb = {1, 1, 1};
  EXPECT_THROW(illuminance_of(image), Error);
}

}  // namespace
}  // namespace nightcity::measure
