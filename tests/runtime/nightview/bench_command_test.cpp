// The memory that bench says passes move is that of the pixels that are rendered.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "shaders/frame.h"
#include "support/process.h"
#include "support/scene_files.h"
#include "support/scenes.h"

namespace nightcity::nightview {
namespace {

TEST(BenchCommand, CountsTheRecordsOfPixelsThatAreRendered) {
  const test::TempFolder folder;
  test::SceneBuilder builder;
  builder.ground(20);
  test::write_scene_files(folder / "city.glb", builder.scene(), {test::lamp({-6, 6, 3}, 5000)});
  const auto bench = [&](const std::string& options) {
    const test::Outcome outcome =
        test::run_program("nightview", "-q bench" + test::quoted(folder / "city.glb") +
                                           "--size 64x48 --frames 1 --warm-up 1 --json " + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out);
  };
  const auto whole = bench(""), half = bench("--resolution-scale 0.5");
  EXPECT_EQ(whole["record_bytes"]["primary"], 64 * 48 * sizeof(gpu::Surface));
  EXPECT_EQ(half["record_bytes"]["primary"], 32 * 24 * sizeof(gpu::Surface));
  EXPECT_GT(whole["copied_bytes_per_s"], 0);
  for (const char* pass : {"candidates", "temporal", "shade", "accumulate"})
    EXPECT_GT(whole["record_bytes"][pass], 0) << pass;
}

}  // namespace
}  // namespace nightcity::nightview
