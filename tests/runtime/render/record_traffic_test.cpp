// The bytes that passes have to move are of the passes that run, and no more than what there is.
#include "runtime/render/record_traffic.h"

#include <gtest/gtest.h>

#include <set>

#include "runtime/render/copy_speed.h"
#include "shaders/frame.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::render {
namespace {

TEST(RecordTraffic, NamesTheStepsOfAFrame) {
  const scene::RenderScene scene = test::random_town(30, 60, 7).with(test::random_lamps(20, 50, 8));
  DeviceScene device_scene(test::test_device(), scene);
  Renderer renderer(test::test_device(), test::test_passes(), device_scene, 64, 48);
  for (const Estimator estimator : {Estimator::traced, Estimator::paper, Estimator::ris})
    for (const bool denoise : {false, true}) {
      RenderSettings settings;
      settings.sampling.estimator = estimator;
      settings.display.denoise = denoise;
      for (int i = 0; i < 2; ++i)
        renderer.render_frame({{40, 30, 40}, {0, 0, 0}, {0, 1, 0}, 50}, settings);
      std::set<std::string> run, told;
      for (const auto& span : renderer.timings()) run.insert(span.name);
      for (const auto& pass : find_record_bytes(settings)) told.insert(pass.first);
      EXPECT_EQ(told, run) << name_of(estimator) << (denoise ? ", denoised" : "");
    }
}

// A pairing more adds a partner and a target that one pass writes and the other reads.
TEST(RecordTraffic, GrowsWithWhatAPassKeeps) {
  RenderSettings settings;
  settings.sampling.estimator = Estimator::traced;
  settings.reuse.disocclusion_boost = 0;
  settings.reuse.neighbours = 2;
  auto few = find_record_bytes(settings);
  settings.reuse.neighbours = 3;
  auto more = find_record_bytes(settings);
  constexpr std::size_t partner = sizeof(std::uint32_t) + sizeof(gpu::ReflectedSample);
  EXPECT_EQ(more["spatial targets"] - few["spatial targets"], partner);
  EXPECT_EQ(more["spatial"] - few["spatial"], partner);
  EXPECT_EQ(more["temporal"], few["temporal"]);
  settings.averaging.window = 30;
  EXPECT_EQ(find_record_bytes(settings)["accumulate"] - more["accumulate"],
            2 * sizeof(gpu::Surface));
}

// Between what no memory reaches and 1 % of what the slowest does.
TEST(CopySpeed, IsThatOfMemory) {
  const double bytes_per_s = measure_copy_speed(test::test_device());
  EXPECT_GT(bytes_per_s, 1e8);
  EXPECT_LT(bytes_per_s, 1e14);
  EXPECT_TRUE(test::test_device().validation_messages().empty());
}

TEST(RecordTraffic, KnowsNothingOfAFrameAtHalfRate) {
  RenderSettings settings;
  settings.sampling.half_rate = true;
  EXPECT_TRUE(find_record_bytes(settings).empty());
}

}  // namespace
}  // namespace nightcity::render
