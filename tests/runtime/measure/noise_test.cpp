#include "runtime/measure/noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "formats/error.h"

namespace nightcity::measure {
namespace {

Image make_noisy(float value, float deviation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise;  // of deviation 1: the standard leaves 0 undefined
  Image image;
  image.width = 64;
  image.height = 48;
  image.rgb.resize(std::size_t{3} * 64 * 48);
  for (float& v : image.rgb) v = value + deviation * noise(random);
  return image;
}

TEST(RelativeNoise, IsTheDeviationOverTheMean) {
  // The squared mean of two noisy values is above the square of the true mean by half the variance:
  // two per mille here.
  const std::vector<Image> two{make_noisy(2, 0.1f, 1), make_noisy(2, 0.1f, 2)};
  EXPECT_NEAR(find_relative_noise(two), 0.05 / std::sqrt(1.01), 0.05 * 0.03);
  const std::vector<Image> equal{two[0], two[0]};
  EXPECT_EQ(find_relative_noise(equal), 0);
  Image black = two[0];
  black.rgb.assign(black.rgb.size(), 0);
  EXPECT_EQ(find_relative_noise(std::vector<Image>{black, black}), 0);
}

TEST(RelativeNoise, NeedsTwoPicturesOfOneSize) {
  const Image image = make_noisy(1, 0.1f, 1);
  EXPECT_THROW(find_relative_noise(std::vector<Image>{image}), Error);
  Image smaller = image;
  smaller.rgb.resize(3);
  EXPECT_THROW(find_relative_noise(std::vector<Image>{image, smaller}), Error);
}

TEST(AverageLight, LeavesSurfacesAlone) {
  Image a = make_noisy(1, 0, 1), b = make_noisy(3, 0, 1);
  a.info.frames = b.info.frames = 8;
  a.layers = {{"sky", {"Y"}, {2}}, {"feature", {"Y"}, {5}}};
  b.layers = {{"sky", {"Y"}, {4}}, {"feature", {"Y"}, {6}}};
  average_light(a, b);
  EXPECT_EQ(a.rgb[0], 2);
  EXPECT_EQ(a.layers[0].values[0], 3);
  EXPECT_EQ(a.layers[1].values[0], 5);
  EXPECT_EQ(a.info.frames, 16u);
}

}  // namespace
}  // namespace nightcity::measure
