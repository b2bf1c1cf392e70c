// Compares every pixel of an estimator's picture with the reference over independent runs: unbiased
// ones differ by noise alone, the paper's 1/M weights by more.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "support/berlin.h"
#include "support/estimators.h"
#include "support/independent_runs.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

render::RenderSettings settings_for(render::Estimator estimator) {
  return with_estimator(estimator, 16);
}

struct Place {
  scene::RenderScene scene;
  scene::CameraPose pose;
  std::uint32_t side;
};

// The criterion of Mitsuba 3's renderer tests: at a joint level of 1 %, at most 0.25 % of the
// pixels may differ.
constexpr double enough = 0.9975;

struct Verdict {
  measure::PixelTest pixels;
  double z = 0;  // of the picture's mean
};

Verdict judge(const Place& place, const render::RenderSettings& settings, std::uint32_t runs,
              std::uint32_t frames) {
  render::DeviceScene device_scene(test_device(), place.scene);
  render::Renderer renderer(test_device(), test_passes(), device_scene, place.side, place.side);
  const measure::PictureStatistics truth = independent_runs(
      renderer, place.pose, settings_for(render::Estimator::reference), 16, 4, 5000);
  const measure::PictureStatistics ours =
      independent_runs(renderer, place.pose, settings, runs, frames);
  Verdict verdict{measure::test_pixels(ours, truth, 0.01, 1e-4), 0};
  verdict.z = verdict.pixels.relative_mean / verdict.pixels.relative_mean_error;
  testing::Test::RecordProperty("rejected", int(verdict.pixels.rejected));
  std::printf("  %-10s %6.2f %% of %zu pixels pass, mean %+.3f %% +- %.3f %%\n",
              render::name_of(settings.sampling.estimator), 100 * verdict.pixels.passed_share(),
              verdict.pixels.pixels, 100 * verdict.pixels.relative_mean,
              100 * verdict.pixels.relative_mean_error);
  return verdict;
}

void expect_unbiased(const Place& place, const render::RenderSettings& settings,
                     std::uint32_t runs = 48, std::uint32_t frames = 6) {
  const Verdict verdict = judge(place, settings, runs, frames);
  EXPECT_GE(verdict.pixels.passed_share(), enough);
  EXPECT_LT(std::abs(verdict.z), 4);
  EXPECT_LT(verdict.pixels.relative_mean_error, 0.01) << "too noisy to tell";
}

void expect_unbiased(const Place& place, render::Estimator estimator, std::uint32_t runs = 48,
                     std::uint32_t frames = 6) {
  expect_unbiased(place, settings_for(estimator), runs, frames);
}

void expect_biased(const Place& place, render::Estimator estimator, std::uint32_t runs = 144,
                   std::uint32_t frames = 6) {
  const Verdict verdict = judge(place, settings_for(estimator), runs, frames);
  EXPECT_LT(verdict.pixels.passed_share(), enough);
  EXPECT_LT(verdict.z, -3);
}

// Boxes on a plane with lamps and windows: shadows and one-sided lights, where neighbours differ.
Place analytic() {
  const SceneBuilder builder = boxes_on_a_plane();
  std::vector<Light> lights;
  for (int i = 0; i < 12; ++i)
    lights.push_back(lamp({float(i % 4) * 6 - 9, 4.5f, float(i / 4) * 7 - 8.5f}, 4000, 0.2f));
  for (int i = 0; i < 6; ++i)
    lights.push_back(window({float(i) * 2 - 5, 3, -9.9f}, {0, 0, 1}, 0.6f, 0.9f, 400));
  return {builder.with(lights), {{-9, 10, 17}, {0, 1, 0}, {0, 1, 0}, 50}, 24};
}

// The same with two lamps behind the large box that outshine the others a thousand times: hidden
// from most of the picture, and seen past the box from some of it.
Place analytic_with_hidden_lamps() {
  Place place = analytic();
  std::vector<Light> lights(place.scene.lights.begin(), place.scene.lights.end());
  lights.push_back(lamp({-1, 3, -16}, 4e6f, 0.2f));
  lights.push_back(lamp({2, 4, -17}, 4e6f, 0.2f));
  place.scene = boxes_on_a_plane().with(lights);
  place.side = 16;
  return place;
}

Place town() {
  const SceneBuilder builder = random_town(120, 50, 11);
  return {builder.with(under_open_sky(builder, random_lamps(150, 50, 5))),
          {{-45, 25, 50}, {0, 2, 0}, {0, 1, 0}, 50},
          24};
}

TEST(Unbiased, TheDefaultOnAnAnalyticScene) {
  expect_unbiased(analytic(), render::RenderSettings{}.sampling.estimator);
}
TEST(Unbiased, TheDefaultWhereHiddenLampsOutshineTheRest) {
  // Few of a frame's candidates are seen, so the picture is noisy.
  expect_unbiased(analytic_with_hidden_lamps(), render::RenderSettings{}.sampling.estimator, 768);
}
// Most of the picture shows less than thirty steps, so roulette decides about most samples.
TEST(Unbiased, WithRouletteForMostSamples) {
  render::RenderSettings settings = settings_for(render::RenderSettings{}.sampling.estimator);
  settings.sampling.roulette_steps = 30;
  expect_unbiased(analytic(), settings, 192);
}
TEST(Unbiased, RisOnAnAnalyticScene) {
  expect_unbiased(analytic(), render::Estimator::ris);
}
TEST(Unbiased, PairwiseOnAnAnalyticScene) {
  expect_unbiased(analytic(), render::Estimator::pairwise);
}
TEST(Unbiased, BasicOnAnAnalyticScene) {
  expect_unbiased(analytic(), render::Estimator::basic);
}
TEST(Unbiased, ThePapersWeightsAreNotOnAnAnalyticScene) {
  expect_biased(analytic(), render::Estimator::paper);
}

TEST(Unbiased, TheDefaultInATown) {
  expect_unbiased(town(), render::RenderSettings{}.sampling.estimator);
}
TEST(Unbiased, ThePapersWeightsAreNotInATown) {
  expect_biased(town(), render::Estimator::paper);
}

// Surfaces alone decide which pixels share samples, so neither option brings bias, nor do partners
// in any number.
TEST(Unbiased, WithBoostAndPermutationInATown) {
  render::RenderSettings settings = settings_for(render::RenderSettings{}.sampling.estimator);
  settings.reuse.neighbours = 6;
  settings.reuse.disocclusion_boost = 12;
  settings.reuse.permute = true;
  expect_unbiased(town(), settings);
}

TEST(Unbiased, TheDefaultInBerlinAndThePapersWeightsNot) {
  BAKED_BERLIN(berlin, false, false);
  Place place{scene::load_render_scene(berlin / "city.glb"), {}, 24};
  place.pose = scene::find_camera("overview", place.scene);
  // Forty metres a pixel: few samples carry much of a pixel's light, and means of fewer runs are
  // not yet distributed as Welch's test assumes.
  expect_unbiased(place, render::RenderSettings{}.sampling.estimator, 384);
  expect_biased(place, render::Estimator::paper);
  // The same with pixels of a metre instead of forty.
  place.pose.fov_deg = 5;
  expect_unbiased(place, render::RenderSettings{}.sampling.estimator);
}

}  // namespace
}  // namespace nightcity::test
