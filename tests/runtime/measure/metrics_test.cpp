#include "runtime/measure/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "formats/error.h"
#include "runtime/measure/exposure.h"
#include "runtime/measure/pictures.h"

namespace nightcity::measure {
namespace {

using test::grey;
using test::set_pixel;

TEST(Compare, PictureWithItselfDiffersByNothing) {
  const Image image = grey(7, 5, 0.3f);
  const Comparison result = compare(image, image);
  EXPECT_EQ(result.rmse8, 0);
  EXPECT_EQ(result.relative_mse, 0);
  EXPECT_EQ(result.relative_mse_luminance, 0);
  EXPECT_EQ(result.mean_signed_error, 0);
  EXPECT_EQ(result.relative_mean_signed_error, 0);
  EXPECT_EQ(result.fireflies, 0);
}

TEST(Compare, ConstantOffsetHasItsClosedForm) {
  // a = 1.5, b = 2: (a - b)^2 / (b^2 + 0.01 b^2) = 0.25 / 4.04.
  const Comparison result = compare(grey(8, 8, 1.5f), grey(8, 8, 2.0f));
  EXPECT_NEAR(result.mean_signed_error, -0.5, 1e-6);
  EXPECT_NEAR(result.relative_mean_signed_error, -0.25, 1e-6);
  EXPECT_NEAR(result.relative_mse, 0.25 / 4.04, 1e-7);
  EXPECT_NEAR(result.relative_mse_luminance, 0.25 / 4.04, 1e-7);
  EXPECT_NEAR(result.mean_luminance, 1.5, 1e-6);
  EXPECT_NEAR(result.reference_mean_luminance, 2.0, 1e-6);
}

TEST(Compare, Rmse8IsTheDifferenceOfCodeValues) {
  Image a = grey(4, 1, 1.0f);
  const Image b = grey(4, 1, 1.0f);
  set_pixel(a, 2, 0, 3.0f);
  const float ev100 = 3.0f, scale = tonemap::exposure_scale(ev100);
  const double step =
      to_code_value(3.0f * scale, TONEMAP_FILMIC) - to_code_value(1.0f * scale, TONEMAP_FILMIC);
  ASSERT_GT(step, 10);
  // One pixel of four differs, in all three channels alike.
  EXPECT_NEAR(compare(a, b, ev100).rmse8, std::sqrt(step * step / 4), 1e-9);
}

TEST(Compare, BothPicturesGetTheReferencesExposure) {
  Image dark = grey(4, 4, 0.01f), bright = grey(4, 4, 10.0f);
  const Comparison metered = compare(dark, bright);
  EXPECT_EQ(metered.ev100, auto_exposure_ev100(bright));
  EXPECT_GT(metered.rmse8, 50);  // each with its own exposure would look the same

  bright.info.ev100 = 5.0f;
  dark.info.ev100 = 1.0f;
  EXPECT_EQ(compare(dark, bright).ev100, 5.0f);
  EXPECT_EQ(compare(dark, bright, 7.0f).ev100, 7.0f);
}

TEST(Compare, SignedErrorKeepsItsSignWhereSquaresCancelIt) {
  Image a = grey(2, 1, 1.0f);
  set_pixel(a, 0, 0, 0.5f);
  set_pixel(a, 1, 0, 1.5f);
  const Comparison result = compare(a, grey(2, 1, 1.0f));
  EXPECT_NEAR(result.mean_signed_error, 0, 1e-7);
  EXPECT_NEAR(result.relative_mse, 0.25 / 1.01, 1e-6);
}

TEST(Compare, FloorKeepsTheDarkFromDecidingTheRelativeError) {
  Image b = grey(100, 1, 1.0f), a = b;
  set_pixel(b, 50, 0, 0.0f);
  set_pixel(a, 50, 0, 0.01f);
  // mean = 0.99, eps = 0.01 * 0.99^2: one pixel of a hundred has (0.01)^2 / eps.
  EXPECT_NEAR(compare(a, b).relative_mse, 1e-4 / (0.01 * 0.99 * 0.99) / 100, 1e-8);
}

TEST(Compare, FireflyIsOneOnlyWhereNoNeighbourIsAsBright) {
  Image b = grey(10, 10, 1.0f), a = b;
  set_pixel(a, 5, 5, 12.0f);  // over 10 * (1 + 0.1 * mean)
  EXPECT_DOUBLE_EQ(compare(a, b).fireflies, 0.01);
  set_pixel(a, 5, 5, 10.9f);  // under it
  EXPECT_EQ(compare(a, b).fireflies, 0);
  set_pixel(a, 5, 5, 12.0f);
  set_pixel(b, 6, 6, 2.0f);  // a neighbour in the reference explains it
  EXPECT_EQ(compare(a, b).fireflies, 0);
}

TEST(Compare, FireflyInACornerIsFound) {
  const Image b = grey(3, 3, 1.0f);
  for (const std::uint32_t x : {0u, 2u})
    for (const std::uint32_t y : {0u, 2u}) {
      Image a = b;
      set_pixel(a, x, y, 100.0f);
      EXPECT_DOUBLE_EQ(compare(a, b).fireflies, 1.0 / 9);
    }
}

TEST(Compare, NoiseInTheDarkIsNoFirefly) {
  Image b = grey(10, 10, 1.0f), a = b;
  for (std::uint32_t y = 0; y < 5; ++y)
    for (std::uint32_t x = 0; x < 10; ++x) set_pixel(b, x, y, 0.0f), set_pixel(a, x, y, 0.0f);
  set_pixel(a, 2, 2, 0.1f);  // infinitely brighter than its neighbours, yet a fifth of the mean
  EXPECT_EQ(compare(a, b).fireflies, 0);
}

TEST(Compare, SizesMustMatch) {
  EXPECT_THROW(compare(grey(4, 2, 1), grey(2, 4, 1)), Error);
  EXPECT_THROW(compare(Image(), Image()), Error);
}

TEST(Compare, NonFinitePixelIsRefusedWithItsPlace) {
  Image broken = grey(4, 4, 1.0f);
  broken.rgb[3 * (2 * 4 + 1) + 1] = std::numeric_limits<float>::quiet_NaN();
  try {
    compare(grey(4, 4, 1.0f), broken);
    FAIL() << "NaN was measured";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("reference"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("(1, 2)"), std::string::npos) << error.what();
  }
  broken.rgb[3 * (2 * 4 + 1) + 1] = std::numeric_limits<float>::infinity();
  EXPECT_THROW(compare(broken, grey(4, 4, 1.0f)), Error);
}

TEST(Compare, BlackReferenceHasNoRelativeError) {
  EXPECT_THROW(compare(grey(2, 2, 1.0f), grey(2, 2, 0.0f)), Error);
  const Comparison nothing = compare(grey(2, 2, 0.0f), grey(2, 2, 0.0f));
  EXPECT_EQ(nothing.relative_mse, 0);
  EXPECT_EQ(nothing.rmse8, 0);
}

}  // namespace
}  // namespace nightcity::measure
