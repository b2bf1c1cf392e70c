// Debian 12's CPU driver silently ends loops after 65,535 steps, summed over an invocation. The
// reference's chunks stay below that in every scene; a probe shows whether the present driver has
// the limit.
#include <gtest/gtest.h>

#include <cstdint>

#include "oracle/oracle.h"
#include "runtime/gpu/buffer.h"
#include "runtime/gpu/compute_pass.h"
#include "spirv/step_probe.h"
#include "support/independent_runs.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

// Returns how many of `wanted` steps in two nested loops the driver lets one invocation make.
std::uint32_t steps_made(std::uint32_t outer, std::uint32_t inner) {
  gpu::Device& device = test_device();
  gpu::Buffer result(device, sizeof(std::uint32_t));
  struct Push {
    std::uint64_t result;
    std::uint32_t outer, inner;
  } const push{result.address(), outer, inner};
  const gpu::ComputePass probe(device, step_probe_spirv, {}, sizeof(push));
  device.run([&](VkCommandBuffer commands) {
    probe.dispatch(commands, &push, 1);
    gpu::full_barrier(commands);
  });
  return result.read<std::uint32_t>(1)[0];
}

TEST(StepLimit, LoopsBelowItAreWhole) {
  EXPECT_EQ(steps_made(200, 200), 40000u);
}

TEST(StepLimit, WhatTheDriverGivesIsAllOr65535) {
  const std::uint32_t made = steps_made(1, 200000);
  std::printf("  %s: %u of 200000 steps\n", test_device().info().name.c_str(), made);
  if (made != 200000u) {
    EXPECT_EQ(made, 65535u);
    EXPECT_LT(steps_made(2000, 100), 200000u) << "the limit is summed over nested loops";
  }
}

// 5,000 lights and 300,000 triangles: an unchunked loop would need a million steps a pixel.
TEST(StepLimit, FiveThousandLightsIn300000TrianglesEqualTheOracle) {
  const SceneBuilder town = random_town(25000, 700, 3);
  std::vector<Light> lights = random_lamps(5000, 700, 8);
  for (Light& light : lights) light.radius = 0;  // points: no noise on either side
  const scene::RenderScene scene = town.with(lights);
  EXPECT_GE(scene.triangles.size(), 300000u);
  render::RenderSettings settings;
  settings.sampling.estimator = render::Estimator::reference;
  settings.sampling.jitter = false;
  const scene::CameraPose pose{{-300, 120, 300}, {0, 0, 0}, {0, 1, 0}, 50};
  constexpr std::uint32_t side = 12;
  measure::PictureStatistics ours, truth;
  ours.add(render(scene, pose, settings, side, side, 1));
  truth.add(oracle::Oracle(town.scene(), {lights, {}, {}}).render(pose, side, side, 1, 1));
  const measure::PixelTest test = measure::test_pixels(ours, truth, 0.01, 0.001);
  EXPECT_GT(truth.picture_mean(), 0.0);
  EXPECT_NEAR(test.relative_mean, 0.0, 0.002);
  EXPECT_LE(test.rejected, 2u);  // edges of hard shadows
}

}  // namespace
}  // namespace nightcity::test
