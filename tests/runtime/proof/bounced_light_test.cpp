// Light that bounces: the reference's paths against the oracle's (other code, another ray tracer),
// and one path a pixel against the reference.
#include <gtest/gtest.h>

#include <cstdio>

#include "oracle/oracle.h"
#include "support/estimators.h"
#include "support/lit_place.h"

namespace nightcity::test {
namespace {

constexpr std::uint32_t side = 24;  // whole workgroups

// The camera sees into the yard.
LitPlace courtyard() {
  return test::courtyard({{-9, 10, 17}, {0, 1, 0}, {0, 1, 0}, 50}, 0.05f);
}

render::RenderSettings with_bounces(render::Estimator estimator, std::uint32_t bounces) {
  render::RenderSettings settings = with_estimator(estimator, 16);
  settings.indirect.bounces = bounces;
  settings.indirect.cache = false;
  return settings;
}

// The oracle's shadows end elsewhere by its rounding error, which may cost a pixel more.
void expect_oracle(const LitPlace& place, std::uint32_t bounces) {
  const oracle::Oracle oracle(place.builder.scene(), {place.lights, {}, {}});
  measure::PictureStatistics truth;
  for (unsigned run = 0; run < 12; ++run)
    truth.add(oracle.render(place.pose, side, side, 2, run, static_cast<int>(bounces), 8));
  const measure::PictureStatistics ours =
      independent_runs(place, with_bounces(render::Estimator::reference, bounces), side, 12, 8, 1);
  expect_equal(ours, truth, 5e-4, 2);
}

TEST(BouncedLight, OfTheReferenceEqualsTheOraclesOnce) {
  expect_oracle(courtyard(), 1);
}
TEST(BouncedLight, OfTheReferenceEqualsTheOraclesFourTimes) {
  expect_oracle(courtyard(), 4);
}
TEST(BouncedLight, OfGlowingSurfacesEqualsTheOracles) {
  LitPlace place = courtyard();
  place.builder.glow(0.3f);
  expect_oracle(place, 2);
}

// With more lights than the reference adds up at a vertex, it resamples them there.
TEST(BouncedLight, OfLightsThatAreResampledEqualsThatOfOneLight) {
  LitPlace place = courtyard();
  const Light one = place.lights[0];
  constexpr std::uint32_t more = REFERENCE_CHUNK;
  for (std::uint32_t i = 0; i < more; ++i) {
    place.lights.push_back(one);
    place.lights.back().flux_lm = 1;
  }
  render::RenderSettings settings = with_bounces(render::Estimator::reference, 2);
  const measure::PictureStatistics many = independent_runs(place, settings, side, 12, 2, 1);
  // The same flux in one lamp at nearly the same place.
  place.lights.resize(place.lights.size() - more);
  place.lights[0].flux_lm += float(more);
  const measure::PictureStatistics few = independent_runs(place, settings, side, 12, 2, 5000);
  expect_equal(many, few, 1e-4, 1);
}

void expect_unbiased(render::RenderSettings settings, const LitPlace& place) {
  const measure::PictureStatistics ours = independent_runs(place, settings, side, 36, 4, 1);
  settings.sampling.estimator = render::Estimator::reference;
  const measure::PictureStatistics truth = independent_runs(place, settings, side, 16, 6, 5000);
  expect_equal(ours, truth, 1e-4, 1);
}

TEST(BouncedLight, OfOnePathAPixelIsUnbiased) {
  expect_unbiased(with_bounces(render::Estimator::traced, 3), courtyard());
}

// In rain, under a sky and a moon: every lobe and every source.
TEST(BouncedLight, OfOnePathAPixelIsUnbiasedInRainUnderTheMoon) {
  render::RenderSettings settings = with_bounces(render::Estimator::traced, 3);
  settings.environment.wetness = 0.8f;
  settings.environment.sky_cd_m2 = glm::vec3(0.05f);
  settings.environment.moon_lux = glm::vec3(0.25f);
  settings.environment.moon_direction = glm::vec3(0.6f, 0.8f, 0);
  expect_unbiased(settings, courtyard());
}

// The irradiance cache is biased by its smoothing: pixels are off near edges, and the mean is
// right.
TEST(BouncedLight, OfTheCacheHasTheRightMean) {
  const LitPlace place = courtyard();
  render::RenderSettings settings = with_bounces(render::Estimator::traced, 3);
  settings.indirect.cache = true;
  const measure::PictureStatistics ours = independent_runs(place, settings, side, 16, 64, 1);
  settings.sampling.estimator = render::Estimator::reference;
  const measure::PictureStatistics truth = independent_runs(place, settings, side, 24, 8, 5000);
  const measure::PixelTest verdict = measure::test_pixels(ours, truth, 0.01, 1e-4);
  std::printf("  mean %+.3f %% +- %.3f %%\n", 100 * verdict.relative_mean,
              100 * verdict.relative_mean_error);
  EXPECT_NEAR(verdict.relative_mean, 0, 0.003 + 3 * verdict.relative_mean_error);
}

// A lamp that goes out while the clock runs leaves the cache within half a second of the scene.
TEST(BouncedLight, OfALampThatWentOutLeavesTheCache) {
  scene::SceneLights lights;
  lights.lights = {lamp({-6, 7, 0}, 6000, 0.3f), lamp({5, 5, 6}, 3000, 0.05f)};
  lights.switches = {0, 100};
  lights.schedules = {{0, 2}};  // on from 0 to 100 s
  lights.lights[0].schedule = 0;
  const scene::RenderScene scene =
      scene::make_render_scene(boxes_on_a_plane().scene(), std::move(lights));
  render::DeviceScene device_scene(test_device(), scene);
  render::RenderSettings settings = with_bounces(render::Estimator::traced, 2);
  settings.indirect.cache = true;
  const auto mean_at = [&](double first_s, double step_s, int frames) {
    render::Renderer renderer(test_device(), test_passes(), device_scene, side, side);
    for (int i = 0; i < frames; ++i) {
      settings.time_s = first_s + step_s * i;
      renderer.render_frame(courtyard().pose, settings);
    }
    settings.time_s += 1e-9;  // the clock stands: a mean of frames at rest
    for (int i = 0; i < 64; ++i) renderer.render_frame(courtyard().pose, settings);
    return mean_luminance(renderer.download(false));
  };
  const double dark = mean_at(200, 1, 1);
  EXPECT_GT(mean_at(50, 1.0 / 30, 16), 1.5 * dark) << "the lamp matters";
  EXPECT_NEAR(mean_at(99.9, 1.0 / 30, 30), dark, 0.03 * dark);
  EXPECT_NEAR(mean_at(99, 2, 2), dark, 0.02 * dark) << "and at once when the clock jumps";
}

}  // namespace
}  // namespace nightcity::test
