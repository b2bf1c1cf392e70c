// Light that air scatters: the reference against the oracle, which marches the same rays with other
// code, and one sample a frame against the reference.
#include <gtest/gtest.h>

#include "oracle/oracle.h"
#include "support/estimators.h"
#include "support/lit_place.h"

namespace nightcity::test {
namespace {

constexpr std::uint32_t side = 16;

// Seen from above: every ray ends on a surface.
LitPlace courtyard() {
  return test::courtyard({{-9, 14, 17}, {-1, 0, 3}, {0, 1, 0}, 35}, 0.2f);
}

struct Weather {
  const char* name;
  float visibility_km, height_m, asymmetry, albedo;
};

const Weather fog{"fog", 0.1f, 0, 0.8f, 1}, layer{"layer", 0.05f, 6, -0.3f, 0.7f};

render::RenderSettings in(const Weather& weather, render::Estimator estimator) {
  render::RenderSettings settings = with_estimator(estimator, 16);
  settings.air = {.visibility_km = weather.visibility_km,
                  .height_m = weather.height_m,
                  .asymmetry = weather.asymmetry,
                  .albedo = weather.albedo,
                  .candidates = 8,
                  .block = 1};
  return settings;
}

class ScatteredLight : public testing::TestWithParam<Weather> {};

TEST_P(ScatteredLight, OfTheReferenceEqualsTheOracles) {
  const LitPlace place = courtyard();
  const Weather weather = GetParam();
  // The ground is the scene's lowest point.
  const oracle::Air air{3.912 / (1000 * double(weather.visibility_km)), double(weather.height_m), 0,
                        double(weather.asymmetry), double(weather.albedo)};
  const oracle::Oracle oracle(place.builder.scene(), {place.lights, {}, {}});
  measure::PictureStatistics truth;
  for (unsigned run = 0; run < 12; ++run)
    truth.add(oracle.render(place.pose, side, side, 2, run, 0, 1, air));
  const measure::PictureStatistics ours =
      independent_runs(place, in(weather, render::Estimator::reference), side, 12, 32, 1);
  expect_equal(ours, truth, 5e-4, 1);
}

TEST_P(ScatteredLight, OfOneSampleIsUnbiased) {
  LitPlace place = courtyard();
  place.pose = {{-9, 14, 17}, {-1, 0, -3}, {0, 1, 0}, 45};  // onto the windows, too
  const measure::PictureStatistics truth =
      independent_runs(place, in(GetParam(), render::Estimator::reference), side, 16, 64, 5000);
  expect_equal(independent_runs(place, in(GetParam(), render::Estimator::traced), side, 128, 16, 1),
               truth, 1e-4, 1);
}

// Blocks of three pixels do not fit the picture: those at its edges have pixels outside.
TEST_P(ScatteredLight, OfOnePixelOfABlockIsUnbiased) {
  const LitPlace place = courtyard();
  render::RenderSettings settings = in(GetParam(), render::Estimator::traced);
  settings.air.block = 3;
  const measure::PictureStatistics truth =
      independent_runs(place, in(GetParam(), render::Estimator::reference), side, 16, 64, 5000);
  expect_equal(independent_runs(place, settings, side, 64, 48, 1), truth, 1e-4, 1);
}

// Neither a camera that moves nor a vehicle whose lamps move leaves anything of its light behind:
// air keeps no samples of the frame before. Its own frame's geometry shadows it.
TEST_P(ScatteredLight, OfAFrameIsUnbiasedWhileTheCameraMoves) {
  const LitPlace place = courtyard();
  const scene::RenderScene scene = place.scene();
  render::DeviceScene device_scene(test_device(), scene);
  render::Renderer renderer(test_device(), test_passes(), device_scene, side, side);
  render::RenderSettings settings = in(GetParam(), render::Estimator::traced);
  settings.averaging.accumulate = false;
  measure::PictureStatistics moving;
  for (std::uint32_t run = 0; run < count_runs(400); ++run) {
    settings.sampling.seed = run + 1;
    scene::CameraPose before = place.pose;
    before.position += glm::vec3(0.7f, -0.3f, 0.4f);
    renderer.render_frame(before, settings);
    renderer.render_frame(place.pose, settings);
    moving.add(renderer.download(false));
  }
  const measure::PictureStatistics truth =
      independent_runs(place, in(GetParam(), render::Estimator::reference), side, 16, 32, 5000);
  expect_equal(moving, truth, 1e-4, 1);
}

INSTANTIATE_TEST_SUITE_P(Air, ScatteredLight, testing::Values(fog, layer),
                         [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace nightcity::test
