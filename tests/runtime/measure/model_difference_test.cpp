#include "runtime/measure/model_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "formats/error.h"

namespace nightcity::measure {
namespace {

Image make_picture(std::uint32_t width, std::uint32_t height, float value) {
  Image image;
  image.width = width;
  image.height = height;
  image.rgb.assign(std::size_t{3} * width * height, value);
  return image;
}

// Pictures of one value with noise of a standard deviation, each of its own.
std::vector<Image> make_noisy(std::size_t count, float value, float deviation, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<float> noise(value, deviation);
  std::vector<Image> pictures;
  for (std::size_t i = 0; i < count; ++i) {
    pictures.push_back(make_picture(64, 48, 0));
    for (float& v : pictures.back().rgb) v = noise(random);
  }
  return pictures;
}

TEST(ModelDifference, OfPicturesWithoutNoiseIsTheirComparison) {
  const std::vector<Image> a(3, make_picture(4, 4, 1.1f)), b(3, make_picture(4, 4, 1.0f));
  const ModelDifference difference = find_model_difference(a, b);
  EXPECT_NEAR(difference.relative_mean.value, 0.1, 1e-6);
  EXPECT_NEAR(difference.relative_mse.value, 0.01 / 1.01, 1e-6);
  EXPECT_GT(difference.rmse8().value, 1);
  for (const Estimate& estimate :
       {difference.relative_mean, difference.relative_mse, difference.mse8})
    EXPECT_NEAR(estimate.error, 0, 1e-9);
  const ModelDifference none = find_model_difference(b, b);
  EXPECT_EQ(none.relative_mean.value, 0);
  EXPECT_EQ(none.relative_mse.value, 0);
  EXPECT_EQ(none.mse8.value, 0);
}

// Noise of a tenth is 0.01 in a mean of squares. What is left of it after it is taken out is within
// three standard errors of 0, and these are a hundredth of it.
TEST(ModelDifference, DoesNotCountNoise) {
  const ModelDifference equal =
      find_model_difference(make_noisy(8, 1, 0.1f, 1), make_noisy(8, 1, 0.1f, 2));
  EXPECT_LT(std::abs(equal.relative_mse.value), 3 * equal.relative_mse.error);
  EXPECT_LT(equal.relative_mse.error, 2e-4);
  EXPECT_LT(std::abs(equal.mse8.value), 3 * equal.mse8.error);
  EXPECT_LT(std::abs(equal.relative_mean.value), 3 * equal.relative_mean.error);
  const ModelDifference apart =
      find_model_difference(make_noisy(8, 1.1f, 0.02f, 3), make_noisy(8, 1, 0.02f, 4));
  EXPECT_NEAR(apart.relative_mse.value, 0.01 / 1.01, 3 * apart.relative_mse.error + 1e-4);
  EXPECT_NEAR(apart.relative_mean.value, 0.1, 3 * apart.relative_mean.error);
}

// Over 200 repetitions the spread of the estimates is at most the standard error that they state,
// which is at most twice as large, and their mean is the truth within three of its standard errors.
TEST(ModelDifference, StatesItsStandardErrorAsItIs) {
  double sum = 0, squares = 0, stated = 0;
  constexpr int repetitions = 200;
  for (unsigned i = 0; i < repetitions; ++i) {
    const ModelDifference difference = find_model_difference(make_noisy(4, 1.05f, 0.1f, 100 + i),
                                                             make_noisy(4, 1, 0.1f, 900 + i), 1.0f);
    sum += difference.mse8.value;
    squares += difference.mse8.value * difference.mse8.value;
    stated += difference.mse8.error * difference.mse8.error;
  }
  const double mean = sum / repetitions, spread = std::sqrt(squares / repetitions - mean * mean);
  EXPECT_GT(std::sqrt(stated / repetitions), spread);
  EXPECT_LT(std::sqrt(stated / repetitions), 2 * spread);
  const ModelDifference truth =
      find_model_difference(make_noisy(40, 1.05f, 0.1f, 7), make_noisy(40, 1, 0.1f, 8), 1.0f);
  EXPECT_NEAR(mean, truth.mse8.value,
              3 * (spread / std::sqrt(double(repetitions)) + truth.mse8.error));
}

TEST(ModelDifference, DoesNotCountPixelsThatAreLeftOut) {
  std::vector<Image> a(3, make_picture(4, 4, 1.1f));
  const std::vector<Image> b(3, make_picture(4, 4, 1.0f));
  for (Image& picture : a) picture.rgb[3 * 5] = picture.rgb[3 * 5 + 1] = 1e6f;
  std::vector<bool> left_out(16);
  left_out[5] = true;
  const ModelDifference difference = find_model_difference(a, b, std::nullopt, left_out);
  EXPECT_NEAR(difference.relative_mean.value, 0.1, 1e-6);
  EXPECT_NEAR(difference.relative_mse.value, 0.01 / 1.01, 1e-6);
  EXPECT_EQ(difference.ev100, find_model_difference(a, b).ev100) << "metered from all pixels";
  EXPECT_THROW(find_model_difference(a, b, std::nullopt, {true}), Error);
  EXPECT_THROW(find_model_difference(a, b, std::nullopt, std::vector<bool>(16, true)), Error);
}

TEST(ModelDifference, OfBlackPicturesIsNone) {
  const std::vector<Image> black(3, make_picture(2, 2, 0)), grey(3, make_picture(2, 2, 1));
  EXPECT_EQ(find_model_difference(black, black).mse8.value, 0);
  EXPECT_NEAR(find_model_difference(black, grey).relative_mean.value, -1, 1e-12);
  EXPECT_NEAR(find_model_difference(black, grey).relative_mse.value, 1 / 1.01, 1e-9);
  EXPECT_THROW(find_model_difference(grey, black), Error);
}

TEST(ModelDifference, RefusesWhatHasNoDifference) {
  const Image grey = make_picture(2, 2, 1);
  EXPECT_THROW(find_model_difference(std::vector<Image>(2, grey), std::vector<Image>(2, grey)),
               Error);
  EXPECT_THROW(find_model_difference(std::vector<Image>(3, grey), std::vector<Image>(4, grey)),
               Error);
  EXPECT_THROW(find_model_difference(std::vector<Image>(3, grey),
                                     std::vector<Image>(3, make_picture(2, 3, 1))),
               Error);
  std::vector<Image> bad(3, grey);
  bad[1].rgb[5] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(find_model_difference(bad, std::vector<Image>(3, grey)), Error);
}

TEST(ModelDifference, RootsOfSquaresBelowZeroAreZero) {
  EXPECT_EQ(root_of({-1, 4}).value, 0);
  EXPECT_EQ(root_of({-1, 4}).error, 2);
  EXPECT_EQ(root_of({4, 1}).value, 2);
  EXPECT_EQ(root_of({4, 1}).error, 0.25);
}

}  // namespace
}  // namespace nightcity::measure
