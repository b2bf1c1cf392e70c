// A place whose pictures are compared with a truth, pixel by pixel.
#pragma once

#include <cmath>
#include <cstdio>
#include <vector>

#include "support/independent_runs.h"
#include "support/scenes.h"

namespace nightcity::test {

struct LitPlace {
  SceneBuilder builder;
  std::vector<Light> lights;
  scene::CameraPose pose;

  scene::RenderScene scene() const { return builder.with(lights); }
};

/// Returns boxes, a wall and a ground between lamps and windows; some of it no light reaches
/// directly.
inline LitPlace courtyard(const scene::CameraPose& pose, float radius_of_second_lamp) {
  std::vector<Light> lights{lamp({-6, 7, 0}, 6000, 0.3f),
                            lamp({5, 5, 6}, 3000, radius_of_second_lamp)};
  lights[1].colour_rgb9e5 = encode_rgb9e5({1.0f, 0.6f, 0.2f});
  for (int i = 0; i < 4; ++i)
    lights.push_back(window({float(i) * 2 - 5, 3, -9.9f}, {0, 0, 1}, 0.6f, 0.9f, 400));
  return {boxes_on_a_plane(), lights, pose};
}

/// Returns the statistics of `runs` square pictures of a place, of `frames` frames each.
inline measure::PictureStatistics independent_runs(const LitPlace& place,
                                                   const render::RenderSettings& settings,
                                                   std::uint32_t side, std::uint32_t runs,
                                                   std::uint32_t frames, std::uint32_t first_seed) {
  const scene::RenderScene scene = place.scene();
  render::DeviceScene device_scene(test_device(), scene);
  render::Renderer renderer(test_device(), test_passes(), device_scene, side, side);
  return independent_runs(renderer, place.pose, settings, runs, frames, first_seed);
}

/// Expects that two pictures differ by noise and rounding alone: at a joint level of 1 %, at most
/// `pardoned` pixels do not. `rounding` is relative to a pixel's value.
inline void expect_equal(const measure::PictureStatistics& ours,
                         const measure::PictureStatistics& truth, double rounding,
                         std::size_t pardoned) {
  const measure::PixelTest verdict = measure::test_pixels(ours, truth, 0.01, rounding);
  std::printf("  %zu of %zu pixels rejected, mean %+.3f %% +- %.3f %%\n", verdict.rejected,
              verdict.pixels, 100 * verdict.relative_mean, 100 * verdict.relative_mean_error);
  EXPECT_LE(verdict.rejected, pardoned);
  EXPECT_LT(std::abs(verdict.relative_mean), 4 * verdict.relative_mean_error + rounding);
  EXPECT_LT(verdict.relative_mean_error, 0.005) << "too noisy to tell";
}

}  // namespace nightcity::test
