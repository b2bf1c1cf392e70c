// The reference against the oracle (tests/oracle), which has other code and another ray tracer.
#include "oracle/oracle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "formats/scene_reader.h"
#include "runtime/scene/camera.h"
#include "support/berlin.h"
#include "support/estimators.h"
#include "support/independent_runs.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

render::RenderSettings reference() {
  return with_estimator(render::Estimator::reference);
}

measure::PictureStatistics oracle_runs(const oracle::Oracle& oracle, const scene::CameraPose& pose,
                                       std::uint32_t side, std::uint32_t runs, int strata) {
  measure::PictureStatistics statistics;
  for (std::uint32_t run = 0; run < runs; ++run)
    statistics.add(oracle.render(pose, side, side, strata, run));
  return statistics;
}

// Normals are stored in 2 x 16 bits (3e-5 rad off at most), and shadow rays start slightly off the
// surface. These systematic differences matter at grazing angles: 0.05 % of the pixel and of the
// picture's mean are allowed for them.
constexpr double rounding = 0.0005;

// One pixel in a thousand, rounded up, may have a ray or shadow that an edge cuts more finely than
// floats resolve. The mean leaves these pixels out, because a window that one of the two just
// misses outshines the rest of a small picture.
std::size_t pardoned(const measure::PixelTest& test) {
  return (test.pixels + 999) / 1000;
}

void expect_agreement(const measure::PixelTest& test) {
  EXPECT_NEAR(test.relative_mean_passed, 0.0, 0.002 + 2 * test.relative_mean_error);
  EXPECT_LT(test.relative_mean_error, 0.002) << "too noisy to tell";
  EXPECT_LE(test.rejected, pardoned(test))
      << "least p " << test.min_p << " in pixel " << test.min_pixel << ", level " << test.level;
}

measure::PixelTest compare_with_oracle(const scene::RenderScene& scene,
                                       const oracle::Oracle& oracle, const scene::CameraPose& pose,
                                       std::uint32_t side, std::uint32_t runs, int strata,
                                       std::uint32_t frames = 4) {
  render::DeviceScene device_scene(test_device(), scene);
  render::Renderer renderer(test_device(), test_passes(), device_scene, side, side);
  const measure::PictureStatistics ours =
      independent_runs(renderer, pose, reference(), runs, frames);
  EXPECT_GT(ours.picture_mean(), 0.0);
  const measure::PictureStatistics truth = oracle_runs(oracle, pose, side, runs, strata);
  const measure::PixelTest test = measure::test_pixels(ours, truth, 0.01, rounding);
  std::printf(
      "  mean %+.3f %% +- %.3f %%; %zu of %zu pixels rejected, the worst %.4g cd/m2 where the "
      "oracle has "
      "%.4g\n",
      100 * test.relative_mean_passed, 100 * test.relative_mean_error, test.rejected, test.pixels,
      ours.mean(test.min_pixel), truth.mean(test.min_pixel));
  return test;
}

// The oracle itself: E = I cos / d^2 under one lamp, and the closed form of a uniform sphere.
TEST(Oracle, OneLampOverAPlaneIsInverseSquareTimesCosine) {
  SceneBuilder builder(0.4f);
  builder.ground(100);
  for (const float radius : {0.0f, 0.05f, 1.0f}) {
    const oracle::Oracle oracle(builder.scene(), {{lamp({0, 8, 0}, 5000, radius)}, {}, {}});
    // One pixel, straight down beside the lamp at 3 m from its foot.
    const measure::Image image =
        oracle.render({{3, 6, 0}, {3, 0, 0}, {0, 0, -1}, 0.01f}, 1, 1, 32, 1);
    const double d2 = 9 + 64, cosine = 8 / std::sqrt(d2);
    const double expected = 0.4 / std::numbers::pi * 5000 / (4 * std::numbers::pi) * cosine / d2;
    EXPECT_NEAR(luminance(image, 0), expected, 0.001 * expected) << radius;
  }
}

// Lamps, a profile, windows and boxes: every kind of light and shadow in a small picture.
scene::SceneLights every_kind_of_light() {
  scene::SceneLights lights;
  lights.lights = {lamp({-6, 7, 0}, 6000, 0.3f), lamp({5, 5, 6}, 3000, 0),
                   lamp({0, 9, -6}, 8000, 1.0f),
                   window({-4.9f, 3, -9.9f}, {0, 0, 1}, 0.6f, 0.9f, 400),
                   window({9.9f, 2, 0}, {-1, 0, 0}, 2.0f, 0.5f, 900)};
  lights.lights[1].colour_rgb9e5 = encode_rgb9e5({1.0f, 0.6f, 0.2f});
  lights.lights[0].kind_profile = pack_kind_profile(LightKind::sphere, 0);
  lights.profiles = {{4, 19, 0, 90}};
  for (int c = 0; c < 4; ++c)
    for (int g = 0; g < 19; ++g)
      lights.profile_data.push_back(
          float((0.2 + 0.1 * c) * std::cos(g * 5 * std::numbers::pi / 180)));
  return lights;
}

const scene::CameraPose over_boxes{{-9, 10, 17}, {0, 1, 0}, {0, 1, 0}, 50};

TEST(Reference, EqualsTheOracleOnEveryKindOfLight) {
  const SceneBuilder builder = boxes_on_a_plane();
  const scene::SceneLights lights = every_kind_of_light();
  const oracle::Oracle oracle(
      builder.scene(),
      {{lights.lights.begin(), lights.lights.end()}, lights.profiles, lights.profile_data});
  expect_agreement(compare_with_oracle(scene::make_render_scene(builder.scene(), lights), oracle,
                                       over_boxes, 64, 8, 2));
}

// Lamps are shrunk to points and windows to a thousandth, so that neither side has noise: geometry,
// profiles and shadows remain. Shadows are hard, and some pixels lie on their edges.
void shrink(std::span<Light> lights) {
  for (Light& light : lights) {
    light.radius *= light_kind(light) == LightKind::rectangle ? 1e-3f : 0;
    light.half_height *= 1e-3f;
  }
}

void expect_equal(const scene::RenderScene& scene, const oracle::Oracle& oracle,
                  const scene::CameraPose& pose, std::uint32_t side) {
  measure::PictureStatistics ours, truth;
  ours.add(render(scene, pose, reference(), side, side, 1));
  truth.add(oracle.render(pose, side, side, 1, 1));
  const measure::PixelTest test = measure::test_pixels(ours, truth, 0.01, 0.005);
  std::printf("  mean %+.4f %%; %zu of %zu pixels differ by over half a percent\n",
              100 * test.relative_mean_passed, test.rejected, test.pixels);
  EXPECT_GT(truth.picture_mean(), 0.0);
  EXPECT_NEAR(test.relative_mean_passed, 0.0, 0.002);
  EXPECT_LE(test.rejected, test.pixels / 50);
}

TEST(Reference, EqualsTheOracleInATown) {
  const SceneBuilder town = random_town(120, 50, 11);
  std::vector<Light> lights = under_open_sky(town, random_lamps(200, 50, 5));
  shrink(lights);
  const oracle::Oracle oracle(town.scene(), {lights, {}, {}});
  expect_equal(town.with(lights), oracle, {{-45, 25, 50}, {0, 2, 0}, {0, 1, 0}, 50}, 32);
}

// A wrong light must not pass: the same scene with one lamp of three dimmed by a fifth.
TEST(Reference, ADimmedLampIsNoticedByTheOracle) {
  const SceneBuilder builder = boxes_on_a_plane();
  scene::SceneLights lights = every_kind_of_light();
  const oracle::Oracle oracle(
      builder.scene(),
      {{lights.lights.begin(), lights.lights.end()}, lights.profiles, lights.profile_data});
  lights.lights[2].flux_lm *= 0.8f;
  const measure::PixelTest test = compare_with_oracle(
      scene::make_render_scene(builder.scene(), lights), oracle, over_boxes, 32, 12, 2);
  EXPECT_LT(test.relative_mean, -0.005);
  EXPECT_GT(test.rejected, pardoned(test));
}

void expect_equal_in(const TempFolder& berlin, const char* view, std::uint32_t side) {
  scene::RenderScene scene = scene::load_render_scene(berlin / "city.glb");
  const scene::CameraPose pose = scene::find_camera(view, scene);
  shrink(scene.lights);
  oracle::Lights lights = oracle::read_lights(berlin / "city.lights", reference().time_s);
  shrink(lights.lights);
  expect_equal(scene, oracle::Oracle(read_scene(berlin / "city.glb"), std::move(lights)), pose,
               side);
}

TEST(Reference, EqualsTheOracleAmongTheLampsOfBerlin) {
  BAKED_BERLIN(berlin, false);
  expect_equal_in(berlin, "street", 32);
}

// Few pixels, because four thousand windows are lit, too.
TEST(Reference, EqualsTheOracleAmongTheWindowsOfBerlin) {
  BAKED_BERLIN(berlin, true);
  expect_equal_in(berlin, "overview", 16);
}

}  // namespace
}  // namespace nightcity::test
