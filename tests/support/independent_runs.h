// Pictures that share no sample: the runs a test of bias may average.
#pragma once

#include "runtime/measure/significance.h"
#include "support/gpu.h"

namespace nightcity::test {

/// `runs` pictures of `frames` frames each, of seeds `first_seed`, first_seed + 1, ...: another seed starts
/// the mean and the history anew, so the pictures are independent however much the frames of one share.
inline PictureStatistics independent_runs(Renderer& renderer, const CameraPose& pose,
                                          RenderSettings settings, std::uint32_t runs,
                                          std::uint32_t frames, std::uint32_t first_seed = 1) {
  PictureStatistics statistics;
  for (std::uint32_t run = 0; run < runs; ++run) {
    settings.seed = first_seed + run;
    for (std::uint32_t frame = 0; frame < frames; ++frame) renderer.render_frame(pose, settings);
    EXPECT_EQ(renderer.frames(), frames);
    statistics.add(renderer.download(false));
  }
  return statistics;
}

}  // namespace nightcity::test
