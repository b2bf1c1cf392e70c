// The pixel test finds real differences and none between equal pictures.
#include "runtime/measure/significance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "formats/error.h"

namespace nightcity::measure {
namespace {

constexpr std::uint32_t side = 40;

// Pixels of mean 1 (or `shifted` in the first column) with exponential noise, as skewed as a
// renderer's.
PictureStatistics noisy_pictures(int runs, unsigned seed, double shifted = 1.0) {
  std::mt19937 random(seed);
  std::exponential_distribution<double> noise(1.0);
  PictureStatistics statistics;
  for (int run = 0; run < runs; ++run) {
    Image picture;
    picture.width = picture.height = side;
    for (std::uint32_t i = 0; i < side * side; ++i) {
      double y = 0;
      for (int sample = 0; sample < 16; ++sample) y += noise(random) / 16;
      y *= i % side == 0 ? shifted : 1.0;
      picture.rgb.insert(picture.rgb.end(), 3, float(y));
    }
    statistics.add(picture);
  }
  return statistics;
}

// Abramowitz, Stegun: Handbook of mathematical functions, table 26.10.
// Values that each keep a share of the one before (AR(1)): the error of their mean is that of
// independent values times the root of (1 + share) / (1 - share).
TEST(SeriesError, CountsCorrelatedValuesForLess) {
  constexpr std::size_t length = 40'000;
  for (const double kept : {0.0, 0.5, 0.8, 0.95}) {
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0, std::sqrt(1 - kept * kept));
    std::vector<double> series{noise(random)};
    while (series.size() < length) series.push_back(kept * series.back() + noise(random));
    const double expected = std::sqrt((1 + kept) / (1 - kept) / double(length));
    EXPECT_NEAR(find_series_error(series) / expected, 1, 0.12) << kept;
  }
}

TEST(SeriesError, OfAlikeOrTooFewValuesIsZero) {
  EXPECT_EQ(find_series_error({}), 0);
  EXPECT_EQ(find_series_error({3}), 0);
  EXPECT_EQ(find_series_error({3, 3, 3, 3}), 0);
  EXPECT_NEAR(find_series_error({1, 2, 3}), 1 / std::sqrt(3.0), 1e-12) << "as if independent";
}

TEST(Significance, TailsOfStudentsDistributionAreThoseOfTheTables) {
  EXPECT_NEAR(student_tails(12.706, 1), 0.05, 1e-5);
  EXPECT_NEAR(student_tails(2.228, 10), 0.05, 1e-4);
  EXPECT_NEAR(student_tails(3.169, 10), 0.01, 1e-5);
  EXPECT_NEAR(student_tails(1.959964, 1e7), 0.05, 1e-6);
  EXPECT_NEAR(student_tails(0, 5), 1.0, 1e-12);
  EXPECT_NEAR(student_tails(-2.228, 10), student_tails(2.228, 10), 1e-15);
  EXPECT_NEAR(student_tails(1, 1), 0.5, 1e-12);  // Cauchy
  EXPECT_NEAR(find_student_bound(0.05, 1), 12.706, 1e-3);
  EXPECT_NEAR(find_student_bound(0.05, 10), 2.228, 1e-3);
  EXPECT_NEAR(find_student_bound(0.01, 10), 3.169, 1e-3);
}

TEST(Significance, SidaksLevelsMultiplyBackToTheJointOne) {
  for (const std::size_t tests : {1ul, 10ul, 10000ul})
    EXPECT_NEAR(1 - std::pow(1 - sidak_level(0.01, tests), double(tests)), 0.01, 1e-9);
}

TEST(Significance, EqualDistributionsPass) {
  int alarms = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const PixelTest test = test_pixels(noisy_pictures(32, seed), noisy_pictures(32, 1000 + seed));
    alarms += test.rejected > 0;
    EXPECT_EQ(test.pixels, side * side);
    EXPECT_LT(std::abs(test.relative_mean), 5 * test.relative_mean_error);
  }
  EXPECT_LE(alarms, 2);  // 20 tests at 1 %
}

TEST(Significance, AShiftedColumnIsFoundAndOnlyIt) {
  const PixelTest test = test_pixels(noisy_pictures(32, 3, 1.5), noisy_pictures(32, 4));
  EXPECT_GT(test.rejected, side / 2);
  EXPECT_LE(test.rejected, side);
  EXPECT_EQ(test.min_pixel % side, 0u);
  EXPECT_LT(std::abs(test.relative_mean_passed), test.relative_mean);
}

TEST(Significance, WithinTheToleranceNothingDiffers) {
  EXPECT_EQ(test_pixels(noisy_pictures(32, 3, 1.5), noisy_pictures(32, 4), 0.01, 0.5).rejected, 0u);
}

TEST(Significance, PicturesWithoutNoiseMustBeEqual) {
  Image picture;
  picture.width = picture.height = 1;
  picture.rgb = {1, 1, 1};
  PictureStatistics a, b, c;
  a.add(picture);
  b.add(picture);
  EXPECT_EQ(test_pixels(a, b).rejected, 0u);
  picture.rgb = {1, 1.001f, 1};
  c.add(picture);
  EXPECT_EQ(test_pixels(c, b).rejected, 1u);
}

TEST(Significance, WhatIsNotFiniteOrNotOfTheSizeIsRefused) {
  Image picture;
  picture.width = picture.height = 1;
  picture.rgb = {1, 1, 1};
  PictureStatistics statistics;
  statistics.add(picture);
  picture.rgb = {1, std::numeric_limits<float>::quiet_NaN(), 1};
  EXPECT_THROW(statistics.add(picture), Error);
  picture.height = 2;
  picture.rgb.assign(6, 1.0f);
  EXPECT_THROW(statistics.add(picture), Error);
}

TEST(Confidence, IsStudentsTTimesTheStandardError) {
  EXPECT_FALSE(find_confidence({}, 0.95));
  EXPECT_FALSE(find_confidence({3}, 0.95));
  // Mean 2, standard deviation 1, standard error 1 / sqrt(3), two degrees of freedom.
  EXPECT_NEAR(*find_confidence({1, 2, 3}, 0.95), 4.3027 / std::sqrt(3.0), 1e-3);
  EXPECT_EQ(*find_confidence({5, 5}, 0.95), 0);
}

}  // namespace
}  // namespace nightcity::measure
