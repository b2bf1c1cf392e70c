#include "runtime/viewer/metering.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nightcity::viewer {
namespace {

measure::Image grey(float luminance, std::size_t pixels = 10'000) {
  measure::Image image;
  image.width = static_cast<std::uint32_t>(pixels);
  image.height = 1;
  image.rgb.assign(3 * pixels, luminance);
  return image;
}

TEST(Metering, IsTheReflectedLightMetersValueAndIgnoresTheBrightestPerMille) {
  const float plain = meter_picture(grey(0.5f)).ev100;
  EXPECT_NEAR(plain, std::log2(0.5 * 100 / 12.5), 1e-3);
  measure::Image image = grey(0.5f);
  for (std::size_t i = 0; i < 3 * 10; ++i) image.rgb[i] = 1e6f;  // lamps seen directly
  EXPECT_NEAR(meter_picture(image).ev100, plain, 1e-3);
}

// A tenth of the picture is a shop window of 3000 cd/m2, the street has 0.5.
TEST(Metering, ALitWindowBesideTheEyeLeavesTheStreetVisible) {
  measure::Image image = grey(0.5f);
  measure::ImageLayer emitters{"emitter", {"E"}, std::vector<float>(image.pixels())};
  for (std::size_t i = 0; i < image.pixels() / 10; ++i) {
    emitters.values[i] = 1;
    for (std::size_t c = 0; c < 3; ++c) image.rgb[3 * i + c] = 3000;
  }
  const float all = meter_picture(image).ev100;
  image.layers.push_back(emitters);
  const float street = std::log2(0.5f * 100 / 12.5f);
  EXPECT_GT(all, street + 7);
  EXPECT_NEAR(meter_picture(image).ev100, all - 6, 1e-3);
  // An even picture is metered as it was.
  measure::Image even = grey(0.5f);
  even.layers.push_back(emitters);
  EXPECT_NEAR(meter_picture(even).ev100, street, 1e-3);
  // A picture of windows alone is metered as it is.
  measure::Image windows = grey(300);
  windows.layers.push_back({"emitter", {"E"}, std::vector<float>(windows.pixels(), 1)});
  EXPECT_NEAR(meter_picture(windows).ev100, std::log2(300.0f * 100 / 12.5f), 1e-3);
}

TEST(Metering, StaysWithinTheSlidersRange) {
  EXPECT_EQ(meter_picture(grey(1e-6f)).ev100, min_ev100);
  EXPECT_EQ(meter_picture(grey(1e9f)).ev100, max_ev100);
  Metering metering;
  metering.set_target(99);
  EXPECT_EQ(metering.update(0, 0.01), max_ev100);
}

TEST(Metering, ActsAtOnceWhenAskedThenSmoothly) {
  Metering metering;
  metering.set_target(3);
  EXPECT_EQ(metering.update(12, 0), 3);  // at once
  metering.set_target(5);
  float ev = 3, before = 3;
  for (int i = 0; i < 60; ++i) {
    ev = metering.update(ev, 1.0 / 60);
    EXPECT_GE(ev, before);
    EXPECT_LT(ev - before, 0.1f);  // no jump
    before = ev;
  }
  EXPECT_NEAR(ev, 3 + 0.9 * 2, 0.05);
  EXPECT_TRUE(metering.is_moving(ev));
  metering.restart();
  EXPECT_EQ(metering.update(ev, 0), 5);
  EXPECT_FALSE(metering.is_moving(5));
}

TEST(Metering, DoesNotDependOnHowOftenItIsAsked) {
  Metering metering;
  metering.set_target(0);
  metering.update(0, 0);
  metering.set_target(4);
  float often = 0, seldom = 0;
  for (int i = 0; i < 100; ++i) often = metering.update(often, 0.005);
  for (int i = 0; i < 5; ++i) seldom = metering.update(seldom, 0.1);
  EXPECT_NEAR(often, seldom, 1e-3);
}

TEST(Metering, NoiseDoesNotFlicker) {
  Metering metering;
  metering.set_target(2);
  metering.update(2, 0);
  metering.set_target(2.03f);
  EXPECT_EQ(metering.update(2, 0.1), 2);
}

TEST(Metering, TheWhiteFollowsTheLight) {
  const glm::vec3 warm(0.5f, 0.3f, 0.1f), cold(0.3f, 0.3f, 0.4f);
  EXPECT_EQ(follow_light({0, 0, 0}, warm), warm);  // at once
  EXPECT_EQ(follow_light(warm, {0, 0, 0}), glm::vec3(0));
  EXPECT_EQ(follow_light(warm, 1.01f * warm), warm) << "noise does not flicker";
  glm::vec3 white = warm;
  for (int i = 0; i < 30; ++i) white = follow_light(white, cold);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], cold[c], 0.02f);
}

TEST(Metering, WithoutATargetItChangesNothing) {
  Metering metering;
  EXPECT_EQ(metering.update(7, 1), 7);
  EXPECT_FALSE(metering.is_moving(7));
}

}  // namespace
}  // namespace nightcity::viewer
