// Pictures that share no sample, as a test of bias needs them.
#pragma once

#include <cstdlib>

#include "runtime/measure/significance.h"
#include "support/gpu.h"

namespace nightcity::test {

/// Returns `runs` times NIGHTCITY_TEST_RUNS (1): a proof's precision grows with the root of its
/// runs, and the tests have as many as tell within their stated bounds.
inline std::uint32_t count_runs(std::uint32_t runs) {
  const char* factor = std::getenv("NIGHTCITY_TEST_RUNS");
  return factor ? runs * static_cast<std::uint32_t>(std::strtoul(factor, nullptr, 10)) : runs;
}

/// Returns the statistics of count_runs(runs) pictures of `frames` frames each, with seeds
/// `first_seed`, first_seed + 1, ... A new seed restarts mean and history, so the pictures are
/// independent, although the frames of one picture share samples.
inline measure::PictureStatistics independent_runs(render::Renderer& renderer,
                                                   const scene::CameraPose& pose,
                                                   render::RenderSettings settings,
                                                   std::uint32_t runs, std::uint32_t frames,
                                                   std::uint32_t first_seed = 1) {
  measure::PictureStatistics statistics;
  for (std::uint32_t run = 0; run < count_runs(runs); ++run) {
    settings.sampling.seed = first_seed + run;
    for (std::uint32_t frame = 0; frame < frames; ++frame) renderer.render_frame(pose, settings);
    EXPECT_EQ(renderer.frames(), frames);
    statistics.add(renderer.download(false));
  }
  return statistics;
}

}  // namespace nightcity::test
