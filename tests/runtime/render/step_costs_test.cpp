// The costs of a frame's parts against simulated devices: one that takes a while to begin and end,
// and one whose parts differ.
#include "runtime/render/step_costs.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace nightcity::render {
namespace {

constexpr double asked_s = 0.025;

// Runs a step of `parts` on a device that takes `begin_s` and `part_s` for each part. Returns the
// number of runs.
int run_step(StepCosts& costs, std::uint32_t parts, double begin_s, double part_s) {
  int runs = 0;
  for (std::uint32_t done = 0; done < parts; ++runs) {
    const std::uint32_t count = std::min(parts - done, costs.parts_within("shade", parts, asked_s));
    costs.learn("shade", count, begin_s + count * part_s);
    done += count;
  }
  return runs;
}

TEST(StepCosts, APartOfUnknownCostBeginsSmall) {
  StepCosts costs;
  EXPECT_EQ(costs.parts_within("shade", 6400, asked_s), 100u);
  EXPECT_EQ(costs.parts_within("shade", 3, asked_s), 1u);
  costs.learn("shade", 100, 5);  // it was compiled
  EXPECT_EQ(costs.of_part("shade"), 0);
  EXPECT_EQ(costs.parts_within("shade", 6400, asked_s), 100u);
  costs.learn("shade", 100, 0.01);
  EXPECT_DOUBLE_EQ(costs.of_part("shade"), 1e-4);
  EXPECT_DOUBLE_EQ(costs.expect("shade", 300), 0.02);
}

// A coarse picture's step takes as long as the device takes to begin and end it. By that, a step of
// 60 times the parts would be cut into slices for many frames.
TEST(StepCosts, ARunOfFewPartsDoesNotCutLargerOnesForLong) {
  StepCosts costs;
  for (int frame = 0; frame < 4; ++frame) run_step(costs, 60, 6e-4, 1e-7);
  EXPECT_LE(run_step(costs, 3600, 6e-4, 1e-7), 4);
  for (int frame = 0; frame < 3; ++frame) EXPECT_EQ(run_step(costs, 3600, 6e-4, 1e-7), 1) << frame;
}

// Two of five runs meet parts that take twenty times as long as the others. The cheap ones between
// them do not lead to a slice that is far too long.
TEST(StepCosts, TheDearestPartsOfLateDecide) {
  StepCosts costs;
  constexpr double cheap_s = 1e-4, dear_s = 2e-3;
  for (int i = 0; i < 20; ++i) costs.learn("shade", 10, 10 * dear_s);
  for (int i = 0; i < 200; ++i) {
    const bool dear = i % 5 < 2;
    const std::uint32_t count = costs.parts_within("shade", 100'000, asked_s);
    const double seconds = count * (dear ? dear_s : cheap_s);
    EXPECT_LE(seconds, 1.6 * asked_s) << i;
    costs.learn("shade", count, seconds);
  }
}

}  // namespace
}  // namespace nightcity::render
