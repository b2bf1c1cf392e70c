#include "runtime/measure/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "formats/error.h"
#include "runtime/measure/pictures.h"

namespace nightcity::measure {
namespace {

using test::grey;
using test::set_pixel;

constexpr std::uint32_t all_curves[] = {TONEMAP_LINEAR, TONEMAP_REINHARD, TONEMAP_FILMIC};

// The light that an eye adapts to: the mean, without lamps that are seen and the brightest
// fiftieth.
TEST(Exposure, MeanLightLeavesOutWhatShinesItself) {
  Image image = grey(10, 10, 0);
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    image.rgb[3 * i] = 0.4f;
    image.rgb[3 * i + 1] = 0.2f;
  }
  EXPECT_EQ(mean_light(image), glm::vec3(0.4f, 0.2f, 0));
  set_pixel(image, 3, 3, 1e5f);
  set_pixel(image, 4, 3, std::numeric_limits<float>::quiet_NaN());
  EXPECT_NEAR(mean_light(image).r, 0.4f, 1e-6f);
  ImageLayer emitter{"emitter", {"Y"}, std::vector<float>(100, 0)};
  for (std::size_t i = 0; i < 50; ++i) {
    emitter.values[i] = 1;
    image.rgb[3 * i + 2] = 9;
  }
  image.layers.push_back(emitter);
  EXPECT_NEAR(mean_light(image).b, 0, 1e-6f);
  EXPECT_EQ(mean_light(grey(4, 4, 0)), glm::vec3(0));
}

TEST(Exposure, SaturatingLuminanceIsOne) {
  EXPECT_NEAR(1.2f * tonemap::exposure_scale(0.0f), 1.0f, 1e-6);
  EXPECT_NEAR(1.2f * 1024 * tonemap::exposure_scale(10.0f), 1.0f, 1e-6);
}

TEST(Exposure, MeteredGreyLandsAtTheMetersReflectance) {
  // K = 12.5 and q = 0.65: any evenly lit picture is exposed to 12.5 * 0.65 / 78 = 10.4 % of
  // saturation.
  for (const float cd_m2 : {0.002f, 0.5f, 40.0f, 5000.0f}) {
    const float ev100 = auto_exposure_ev100(grey(5, 5, cd_m2));
    EXPECT_NEAR(cd_m2 * tonemap::exposure_scale(ev100), 12.5f * 0.65f / 78.0f, 1e-4) << cd_m2;
  }
}

// Of a grey picture, the first step is the light that to_code_value rounds to 1, at any scale.
TEST(Exposure, TheFirstStepIsTheFirstCodeValueThatIsShown) {
  for (const float cd_m2 : {1e-12f, 0.002f, 40.0f}) {
    const float step = find_first_step(grey(5, 5, cd_m2));
    EXPECT_NEAR(step / cd_m2, 0.0123, 0.0001) << cd_m2;
    const float exposed = step / cd_m2 * 12.5f * 0.65f / 78.0f;
    const auto code = [](float x) { return 255 * tonemap::srgb_encode(tonemap::filmic_curve(x)); };
    EXPECT_GE(code(exposed * 1.001f), 1.0f) << cd_m2;
    EXPECT_LT(code(exposed * 0.999f), 1.0f) << cd_m2;
  }
  EXPECT_EQ(find_first_step(grey(4, 4, 0)), 0.0f);
  EXPECT_TRUE(std::isfinite(find_first_step(grey(4, 4, 3e38f))));
}

TEST(Exposure, TenTimesTheLightIsTenTimesLessExposure) {
  const float low = auto_exposure_ev100(grey(3, 3, 0.1f)),
              high = auto_exposure_ev100(grey(3, 3, 1.0f));
  EXPECT_NEAR(high - low, std::log2(10.0f), 1e-4);
}

TEST(Exposure, LampsAndSkyHaveNoSay) {
  Image street = grey(100, 100, 0.5f);
  for (std::uint32_t y = 0; y < 40; ++y)
    for (std::uint32_t x = 0; x < 100; ++x) set_pixel(street, x, y, 1e-4f);  // the unlit two fifths
  const float without = auto_exposure_ev100(street);
  for (std::uint32_t i = 0; i < 100; ++i)
    set_pixel(street, i, 99, 5e4f);  // one pixel in a hundred is a lamp
  EXPECT_NEAR(auto_exposure_ev100(street), without, 0.01f);
  EXPECT_NEAR(without, auto_exposure_ev100(grey(1, 1, 0.5f)), 0.01f);
}

TEST(Exposure, PictureWithoutLightGetsTheDefault) {
  EXPECT_EQ(auto_exposure_ev100(grey(4, 4, 0.0f)), default_ev100);
  EXPECT_EQ(auto_exposure_ev100(grey(4, 4, std::numeric_limits<float>::quiet_NaN())),
            default_ev100);
  EXPECT_EQ(auto_exposure_ev100(Image()), default_ev100);
  Image one_light = grey(4, 4, 0.0f);
  set_pixel(one_light, 0, 0, 3.0f);
  EXPECT_EQ(auto_exposure_ev100(one_light), auto_exposure_ev100(grey(1, 1, 3.0f)));
}

TEST(Exposure, ExtremesAreClamped) {
  EXPECT_EQ(auto_exposure_ev100(grey(2, 2, 1e-30f)), -12.0f);
  EXPECT_EQ(auto_exposure_ev100(grey(2, 2, 1e30f)), 24.0f);
}

TEST(ToneCurve, RisesFromBlackToWhiteWithoutLeaving) {
  for (const std::uint32_t curve : all_curves) {
    EXPECT_EQ(tonemap::tone_curve(curve, 0.0f), 0.0f);
    float last = 0.0f;
    for (float x = 1e-4f; x < 1e7f; x *= 1.1f) {
      const float y = tonemap::tone_curve(curve, x);
      EXPECT_GE(y, last) << tone_curve_name(curve) << " at " << x;
      EXPECT_LE(y, 1.0f);
      last = y;
    }
    EXPECT_EQ(last, 1.0f) << tone_curve_name(curve);
  }
}

TEST(ToneCurve, BrokenValuesGiveCodeValues) {
  for (const std::uint32_t curve : all_curves) {
    EXPECT_EQ(to_code_value(std::numeric_limits<float>::quiet_NaN(), curve), 0);
    EXPECT_EQ(to_code_value(-3.0f, curve), 0);
    EXPECT_EQ(to_code_value(std::numeric_limits<float>::infinity(), curve), 255);
    EXPECT_EQ(to_code_value(std::numeric_limits<float>::max(), curve), 255);
  }
}

TEST(ToneCurve, LinearWithSrgbHasThePublishedCodeValues) {
  EXPECT_EQ(to_code_value(0.0f, TONEMAP_LINEAR), 0);
  EXPECT_EQ(to_code_value(0.18f, TONEMAP_LINEAR), 118);
  EXPECT_EQ(to_code_value(0.5f, TONEMAP_LINEAR), 188);
  EXPECT_EQ(to_code_value(1.0f, TONEMAP_LINEAR), 255);
  EXPECT_NEAR(tonemap::srgb_encode(0.0031308f), 0.04045f, 1e-5);  // the two pieces meet
}

TEST(ToneCurve, ReinhardReachesWhiteAtItsWhite) {
  EXPECT_NEAR(tonemap::reinhard_curve(REINHARD_WHITE), 1.0f, 1e-6);
  EXPECT_LT(tonemap::reinhard_curve(0.9f * REINHARD_WHITE), 1.0f);
  EXPECT_NEAR(tonemap::reinhard_curve(1e-3f), 1e-3f, 2e-6);
}

TEST(ToneCurve, NamesComeBack) {
  for (const std::uint32_t curve : all_curves)
    EXPECT_EQ(tone_curve_from_name(tone_curve_name(curve)), curve);
  EXPECT_THROW(tone_curve_from_name("Filmic"), UsageError);
}

TEST(Display, EveryPixelIsExposedAlike) {
  Image image = grey(3, 2, 1.2f);
  set_pixel(image, 2, 1, 0.0f);
  const Image8 display = to_display(image, 0.0f, TONEMAP_LINEAR);
  ASSERT_EQ(display.rgb.size(), 18u);
  for (std::size_t i = 0; i < 15; ++i) EXPECT_EQ(display.rgb[i], 255);
  for (std::size_t i = 15; i < 18; ++i) EXPECT_EQ(display.rgb[i], 0);
}

}  // namespace
}  // namespace nightcity::measure
