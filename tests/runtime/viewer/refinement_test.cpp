#include "runtime/viewer/refinement.h"

#include <gtest/gtest.h>

namespace nightcity::viewer {
namespace {

constexpr double pixels = 1280 * 720;

// A device that takes this long for every pixel, and three times as long for a full one.
struct Simulated {
  double quick_pixel_s;
  Refinement refinement{};
  double now_s = 10;
  int frames = 0;

  FramePlan step(bool runs = false) {
    const FramePlan plan = refinement.plan(now_s, pixels, runs);
    const double rendered = pixels / (plan.divisor * plan.divisor);
    const double seconds = rendered * quick_pixel_s * (plan.quick ? 1 : 3);
    now_s += seconds;
    ++frames;
    refinement.complete(plan, rendered, seconds, true);
    return plan;
  }
};

// The CPU driver's time in the demo town: 7 s for a quick picture of all pixels.
constexpr double slow = 7.0 / pixels, fast = 0.002 / pixels;

TEST(Refinement, OnASlowDeviceTheFirstPictureIsTheCoarsestAndTheLastHasEveryPixel) {
  Simulated device{slow};
  device.refinement.change(device.now_s);
  EXPECT_EQ(device.step(), (FramePlan{8, true}));
  double first_fine_s = 0;
  for (int i = 0; i < 20 && first_fine_s == 0; ++i) {
    const std::uint32_t divisor = device.step().divisor;
    EXPECT_NE(divisor, 2u) << "it would take a fourth of the last step";
    if (divisor == 1) first_fine_s = device.now_s - 10;
  }
  EXPECT_GT(first_fine_s, 0);
  EXPECT_LT(first_fine_s, 1.12 * 7);  // the way there costs an eighth of the last step
  EXPECT_FALSE(device.refinement.is_fine());
  EXPECT_EQ(device.step(), (FramePlan{1, false}));
  EXPECT_TRUE(device.refinement.is_fine());
  EXPECT_EQ(device.step(), (FramePlan{1, false}));
}

TEST(Refinement, AFastDeviceIsAtEveryPixelWithinAFewFramesEvenWhileTheViewMoves) {
  Simulated device{fast};
  FramePlan plan;
  for (int i = 0; i < 5; ++i) {
    device.refinement.change(device.now_s);
    plan = device.step();
  }
  EXPECT_EQ(plan, (FramePlan{1, false}));
}

TEST(Refinement, WhileTheViewMovesFramesKeepToTheirTime) {
  for (const double device_s : {0.2, 1.0, 3.0}) {
    Simulated device{device_s / pixels};
    device.refinement.change(device.now_s);
    device.step();
    for (int i = 0; i < 10; ++i) {
      device.refinement.change(device.now_s);
      const double before = device.now_s;
      device.step();
      EXPECT_LE(device.now_s - before, Refinement::moving_frame_s * 1.01) << device_s;
    }
  }
}

TEST(Refinement, ARunningClockCountsAsMotion) {
  Simulated device{slow};
  for (int i = 0; i < 10; ++i) EXPECT_EQ(device.step(true).divisor, 8u);
  device.now_s += Refinement::rest_s;
  EXPECT_EQ(device.step(false).divisor, 4u);
}

TEST(Refinement, AChangeBeginsAtTheCoarseEndAgain) {
  Simulated device{slow};
  while (!device.refinement.is_fine()) device.step();
  device.refinement.change(device.now_s);
  EXPECT_FALSE(device.refinement.is_fine());
  EXPECT_EQ(device.step(), (FramePlan{8, true}));
}

TEST(Refinement, OneSlowFrameDoesNotLowerTheResolutionOfAViewAtRest) {
  Simulated device{fast};
  for (int i = 0; i < 6; ++i) device.step();
  ASSERT_TRUE(device.refinement.is_fine());
  device.refinement.complete({1, false}, pixels, 1.7, true);  // a shader was compiled
  EXPECT_EQ(device.refinement.plan(device.now_s, pixels, false), (FramePlan{1, false}));
}

// If even the coarsest picture takes long, giving up each one for the next would show none.
TEST(Refinement, TheQuickestFrameIsNeverGivenUp) {
  for (const double pixel_s : {slow, 20 * slow, fast}) {
    Simulated device{pixel_s};
    device.refinement.change(device.now_s);
    const FramePlan first = device.step();
    EXPECT_FALSE(device.refinement.is_worth_giving_up(first, pixels)) << pixel_s;
  }
  Simulated device{slow};
  while (!device.refinement.is_fine()) device.step();
  EXPECT_TRUE(device.refinement.is_worth_giving_up({1, false}, pixels));
  EXPECT_TRUE(device.refinement.is_worth_giving_up({2, true}, pixels));
}

TEST(Refinement, AChosenNumberOfPixelsIsKept) {
  for (const double pixel_s : {slow, fast}) {
    Simulated device{pixel_s};
    device.refinement.set_divisor(4);
    device.refinement.change(device.now_s);
    for (int i = 0; i < 5; ++i) EXPECT_EQ(device.step(), (FramePlan{4, false}));
    EXPECT_TRUE(device.refinement.is_fine());
  }
}

TEST(Refinement, APictureOfAnOlderViewDoesNotCountAsThisOne) {
  Refinement refinement;
  refinement.change(5);
  refinement.complete({1, false}, pixels, 0.001, false);
  EXPECT_FALSE(refinement.is_fine());
  EXPECT_EQ(*refinement.frame_s({1, false}, pixels), 0.001);
}

}  // namespace
}  // namespace nightcity::viewer
