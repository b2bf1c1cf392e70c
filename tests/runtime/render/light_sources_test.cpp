// The light of each kind of source against closed forms: layers, moon, sky map, wet streets, upward
// flux.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "runtime/measure/exposure.h"
#include "runtime/measure/false_colour.h"
#include "runtime/render/upward_flux.h"
#include "support/estimators.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::render {
namespace {

using std::numbers::pi;
using test::lamp;
using test::render;
using test::SceneBuilder;
using test::window;

constexpr double albedo = 0.5;  // SceneBuilder's
const scene::CameraPose down{{0, 10, 0}, {0, 0, 0}, {0, 0, -1}, 60};

RenderSettings reference() {
  return test::with_estimator(Estimator::reference);
}

double at_centre(const measure::Image& image) {
  return test::luminance(image, (image.height / 2) * image.width + image.width / 2);
}

double layer_luminance(const measure::Image& image, const char* name, std::size_t pixel) {
  const measure::ImageLayer* layer = image.layer(name);
  if (!layer) ADD_FAILURE() << "no layer " << name;
  const float* v = &layer->values[3 * pixel];
  return 0.2126 * double(v[0]) + 0.7152 * double(v[1]) + 0.0722 * double(v[2]);
}

TEST(Layers, SumToThePictureAndHoldTheirOwnKindOnly) {
  const std::vector<Light> lights{lamp({3, 6, 0}, 4000), window({-6, 3, 0}, {1, 0, 0}, 1, 1, 800)};
  for (const Estimator estimator : {Estimator::reference, Estimator::ris, Estimator::pairwise}) {
    RenderSettings settings = reference();
    settings.sampling.estimator = estimator;
    // A small radius and a short history, as in estimator_test.cpp: otherwise the whole small
    // picture shares a few samples, and the share of each light varies by 4 % from run to run.
    settings.reuse.neighbour_radius_px = 2;
    settings.reuse.max_history = 2;
    settings.sampling.layers = true;
    settings.environment.sky_cd_m2 = glm::vec3(0.05f);
    const measure::Image both =
        render(SceneBuilder().ground(30).with(lights), down, settings, 24, 24, 40);
    double difference = 0, sum = 0, lamps = 0, windows = 0;
    for (std::size_t i = 0; i < both.pixels(); ++i) {
      const double whole = test::luminance(both, i);
      double parts = 0;
      for (const char* part :
           {"direct_lamps", "direct_windows", "direct_vehicles", "sky", "emitted"})
        parts += layer_luminance(both, part, i);
      difference += std::abs(parts - whole);
      sum += whole;
      lamps += layer_luminance(both, "direct_lamps", i);
      windows += layer_luminance(both, "direct_windows", i);
      EXPECT_EQ(layer_luminance(both, "direct_vehicles", i), 0);
    }
    EXPECT_LT(difference / sum, 1e-4) << name_of(estimator);
    const measure::Image lamp_alone =
        render(SceneBuilder().ground(30).with({lights[0]}), down, reference(), 24, 24, 1);
    const measure::Image window_alone =
        render(SceneBuilder().ground(30).with({lights[1]}), down, reference(), 24, 24, 40);
    EXPECT_NEAR(lamps / 576 / test::mean_luminance(lamp_alone), 1, 0.02) << name_of(estimator);
    EXPECT_NEAR(windows / 576 / test::mean_luminance(window_alone), 1, 0.04) << name_of(estimator);
  }
}

// A plain float sum of 3,000 equal values is off by 3e-5.
TEST(Layers, KeepTheirMeanOverThousandsOfFrames) {
  SceneBuilder builder;
  builder.ground(30);
  builder.scene().materials[0].emission_cd_m2 = glm::vec3(0.1f);
  RenderSettings settings = reference();
  settings.sampling.layers = true;
  const measure::Image image = render(builder.with({}), down, settings, 2, 2, 3000);
  EXPECT_NEAR(double(image.layer("emitted")->values[0]) / double(0.1f), 1, 1e-6);
}

TEST(Layers, IlluminanceIsTheClosedFormsWhateverTheSurface) {
  RenderSettings settings = reference();
  settings.sampling.layers = true;
  const measure::Image image = render(SceneBuilder(0.3f).ground(30).with({lamp({0, 8, 0}, 5000)}),
                                      down, settings, 25, 25, 1);
  const auto lux = measure::illuminance_of(image);
  EXPECT_NEAR(double(lux[12 * 25 + 12]), 5000 / (4 * pi) / 64, 0.01 * 5000 / (4 * pi) / 64);
}

TEST(Display, ShowsWhatThePngShowsFromTheDarkToALampSeenDirectly) {
  SceneBuilder builder;
  builder.ground(30);
  builder.scene().materials[0].emission_cd_m2 = {1e6f, 1e6f, 9e5f};
  gpu::Device& device = test::test_device();
  for (const float ev100 : {-4.0f, 3.0f, 19.0f, 24.0f}) {
    const scene::RenderScene scene = builder.with({});
    DeviceScene device_scene(device, scene);
    Renderer renderer(device, test::test_passes(), device_scene, 8, 8);
    RenderSettings settings = reference();
    settings.display.ev100 = ev100;
    renderer.render_frame(down, settings);
    const measure::Image8 png =
        measure::to_display(renderer.download(false), ev100, settings.display.tone);
    const auto words = renderer.display().read<std::uint32_t>(64);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(double(words[27] >> (8 * c) & 255u), double(png.rgb[3 * 27 + c]), 1)
          << "EV " << ev100 << " channel " << c;
  }
}

TEST(Moon, LightsAsItsIlluminanceSaysAndCastsShadows) {
  for (const Estimator estimator : {Estimator::reference, Estimator::pairwise}) {
    RenderSettings settings = reference();
    settings.sampling.estimator = estimator;
    settings.environment.moon_direction = {0, std::sqrt(0.5f), std::sqrt(0.5f)};
    settings.environment.moon_lux = glm::vec3(0.25f);
    const double expected = albedo / pi * 0.25 * std::sqrt(0.5);
    EXPECT_NEAR(at_centre(render(SceneBuilder().ground(30).with({}), down, settings, 9, 9, 1)),
                expected, 0.005 * expected);
    // A wall to the south, a little higher than it is far away.
    const scene::RenderScene walled = SceneBuilder().ground(30).box({-9, 0, 4}, {9, 9, 5}).with({});
    EXPECT_EQ(at_centre(render(walled, down, settings, 9, 9, 1)), 0);
  }
}

TEST(Moon, IsSeenWhereItStandsAndAsBrightAsItLights) {
  RenderSettings settings = reference();
  settings.environment.moon_direction = glm::normalize(glm::vec3(0, 0.3f, -1));
  settings.environment.moon_lux = glm::vec3(0.25f);
  const scene::CameraPose up{{0, 2, 0},
                             glm::vec3(0, 2, 0) + settings.environment.moon_direction,
                             {0, 1, 0},
                             1};  // one degree: the moon fills half
  const measure::Image image = render(SceneBuilder().ground(30).with({}), up, settings, 65, 65, 1);
  const double disc = 0.25 / (pi * MOON_RADIUS * MOON_RADIUS);
  EXPECT_NEAR(at_centre(image), disc, 0.001 * disc);
  EXPECT_EQ(test::luminance(image, 0), 0) << "the corner is beside it";
}

TEST(SkyMap, AnEvenOneIsAUniformSky) {
  scene::RenderScene scene = SceneBuilder().ground(30).box({-3, 0, -6}, {3, 6, -5}).with({});
  RenderSettings settings = reference();
  settings.environment.sky_cd_m2 = glm::vec3(0.2f);
  const double uniform = test::mean_luminance(render(scene, down, settings, 24, 24, 32));
  scene.sky_map = {8, 4, std::vector<float>(96, 0.2f)};
  settings.environment.sky_cd_m2 = glm::vec3(1);
  EXPECT_NEAR(test::mean_luminance(render(scene, down, settings, 24, 24, 32)) / uniform, 1, 1e-4);
}

TEST(SkyMap, KnowsNorthFromSouthAndUpFromDown) {
  scene::RenderScene scene = SceneBuilder().ground(30).with({});
  scene.sky_map = {4, 2, std::vector<float>(24, 0.0f)};
  // Upper row: columns from -180 to 180 degrees of azimuth; the third is from north to east.
  for (int c = 0; c < 3; ++c) scene.sky_map.rgb[std::size_t(3 * 2 + c)] = 7;
  RenderSettings settings = reference();
  settings.environment.sky_cd_m2 = glm::vec3(1);
  const auto seen = [&](glm::vec3 towards) {
    const scene::CameraPose pose{{0, 2, 0}, glm::vec3(0, 2, 0) + towards, {0, 1, 0}, 10};
    return at_centre(render(scene, pose, settings, 9, 9, 1));
  };
  EXPECT_NEAR(seen({1, 0.5f, -1}), 7, 1e-4) << "north-east";
  EXPECT_EQ(seen({-1, 0.5f, -1}), 0) << "north-west";
  EXPECT_EQ(seen({1, 0.5f, 1}), 0) << "south-east";
}

TEST(WetStreet, MirrorsALampByItsMicrofacetsAndDarkensTheRest) {
  // Camera and lamp lie on one vertical line: half vector, light direction and normal coincide, so
  // D = 1 / (pi alpha^2), and shadowing and Fresnel terms are those of normal incidence.
  constexpr double roughness = 0.25, alpha2 = roughness * roughness * roughness * roughness,
                   f0 = 0.02, kept = 0.6;
  const double illuminance = 5000 / (4 * pi) / 64;
  RenderSettings settings = reference();
  settings.environment.wetness = 1;
  const scene::RenderScene scene = SceneBuilder().ground(30).with({lamp({0, 8, 0}, 5000, 0.01f)});
  const double expected = illuminance * (kept * albedo / pi + f0 / (4 * pi * alpha2));
  EXPECT_NEAR(at_centre(render(scene, {{0, 12, 0}, {0, 0, 0}, {0, 0, -1}, 5}, settings, 33, 33, 1)),
              expected, 0.02 * expected);
  // A wall stays dry.
  const scene::RenderScene wall = SceneBuilder()
                                      .quad({-9, 0, -5}, {9, 0, -5}, {9, 9, -5}, {-9, 9, -5})
                                      .with({lamp({0, 4, 3}, 5000)});
  const scene::CameraPose facing{{0, 4, 2}, {0, 4, -5}, {0, 1, 0}, 40};
  const measure::Image wet = render(wall, facing, settings, 9, 9, 1),
                       dry = render(wall, facing, reference(), 9, 9, 1);
  if (test::test_device().info().kind == "cpu") {
    EXPECT_EQ(wet.rgb, dry.rgb);
  }
  // These are two compiled passes, and a GPU may round each differently.
  for (std::size_t i = 0; i < dry.rgb.size(); ++i)
    EXPECT_NEAR(wet.rgb[i], dry.rgb[i], 1e-5f * dry.rgb[i]);
}

TEST(Water, MirrorsALampWithoutRain) {
  // As above, without the darkening of what is wet.
  constexpr double roughness = 0.25, alpha2 = roughness * roughness * roughness * roughness,
                   f0 = 0.02;
  const double illuminance = 5000 / (4 * pi) / 64;
  scene::RenderScene scene = SceneBuilder().ground(30).with({lamp({0, 8, 0}, 5000, 0.01f)});
  for (gpu::Material& material : scene.materials) material.roughness = 0.05f;
  const double expected = illuminance * (albedo / pi + f0 / (4 * pi * alpha2));
  for (const float wetness : {0.0f, 0.5f}) {
    RenderSettings settings = reference();
    settings.environment.wetness = wetness;
    EXPECT_NEAR(
        at_centre(render(scene, {{0, 12, 0}, {0, 0, 0}, {0, 0, -1}, 5}, settings, 33, 33, 1)),
        expected, 0.02 * expected);
  }
}

TEST(WetStreet, EstimatorsAgreeOnIt) {
  const scene::RenderScene scene =
      SceneBuilder().ground(30).with({lamp({4, 6, -8}, 5000), lamp({-5, 6, -3}, 3000)});
  const scene::CameraPose pose{{0, 3, 12}, {0, 0, -5}, {0, 1, 0}, 60};
  RenderSettings settings = reference();
  settings.environment.wetness = 0.8f;
  const double truth = test::mean_luminance(render(scene, pose, settings, 24, 24, 8));
  settings.sampling.estimator = Estimator::pairwise;
  EXPECT_NEAR(test::mean_luminance(render(scene, pose, settings, 24, 24, 64)) / truth, 1, 0.02);
}

UpwardFlux upward(const scene::RenderScene& scene, UpwardSettings settings = {}) {
  gpu::Device& device = test::test_device();
  DeviceScene device_scene(device, scene);
  return measure_upward_flux(device, test::test_passes(), device_scene, settings);
}

// Lights that an edit switched off keep their places among the lights, without flux. Candidates
// that are sampled uniformly must be those that shine.
TEST(Edits, LampsThatAreSwitchedOffByHandTakeNoneOfTheOthersLight) {
  std::vector<Light> lights(9, lamp({2, 6, 0}, 0));
  lights.push_back(lamp({3, 6, 0}, 4000));
  const scene::RenderScene some_off = SceneBuilder().ground(30).with(lights);
  RenderSettings settings = reference();
  const double truth = test::mean_luminance(render(some_off, down, settings, 16, 16, 1));
  settings.sampling.near_share = settings.sampling.far_share = 0;
  settings.sampling.uniform_share = 1;
  for (const Estimator estimator : {Estimator::ris, Estimator::pairwise, Estimator::traced}) {
    settings.sampling.estimator = estimator;
    EXPECT_NEAR(test::mean_luminance(render(some_off, down, settings, 16, 16, 20)), truth,
                0.001 * truth)
        << name_of(estimator);
  }
}

TEST(Upward, ABareLampSendsHalfUpAndTheGroundSendsItsAlbedoAfterIt) {
  // A ground of 400 times the lamp's height receives all but 1 / 400 of the downward light.
  const UpwardFlux flux = upward(SceneBuilder().ground(2000).with({lamp({0, 5, 0}, 1000)}));
  ASSERT_EQ(flux.lights.size(), 1u);
  EXPECT_NEAR(flux.lights[0].direct, 0.5, 0.01);
  EXPECT_NEAR(flux.lights[0].reflected, 0.5 * albedo, 0.01);
  EXPECT_NEAR(flux.lights[0].direct + flux.lights[0].sideways + flux.lights[0].reflected / albedo,
              1, 0.01);
  EXPECT_EQ(flux.flux_lm[0], 1000);
  double map = 0;
  for (const double lm : flux.cells_lm) map += lm;
  EXPECT_NEAR(map, 1000 * (flux.lights[0].direct + flux.lights[0].reflected), 1)
      << "the map holds what the lamps lose";
}

TEST(Upward, ARoofOverALampKeepsItsLightDown) {
  const scene::RenderScene scene =
      SceneBuilder().ground(2000).box({-500, 6, -500}, {500, 7, 500}).with({lamp({0, 5, 0}, 1000)});
  const UpwardFlux flux = upward(scene);
  EXPECT_LT(flux.lights[0].direct, 0.01);
  EXPECT_LT(flux.lights[0].reflected, 0.01);
}

TEST(Upward, AWindowSendsHalfOfALambertianHemisphereUp) {
  const UpwardFlux flux =
      upward(SceneBuilder().ground(2000).with({window({0, 5, 0}, {1, 0, 0}, 0.5f, 0.7f, 200)}));
  EXPECT_NEAR(flux.lights[0].direct, 0.5, 0.01);
  EXPECT_NEAR(flux.lights[0].reflected, 0.5 * albedo, 0.01);
}

TEST(Denoiser, KeepsTheMeanAndTheEdgesAndTakesTheNoise) {
  const scene::RenderScene scene = test::random_town(6, 20, 3).with(test::random_lamps(30, 20, 4));
  const scene::CameraPose pose{{-20, 14, 25}, {0, 2, 0}, {0, 1, 0}, 50};
  RenderSettings settings = reference();
  const measure::Image truth = render(scene, pose, settings, 64, 48, 16);
  settings.sampling.estimator = Estimator::ris;
  settings.sampling.candidates = 4;
  const measure::Image noisy = render(scene, pose, settings, 64, 48, 8);
  settings.display.denoise = true;
  const measure::Image filtered = render(scene, pose, settings, 64, 48, 8);
  const auto error = [&](const measure::Image& image) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i)
      sum += std::abs(test::luminance(image, i) - test::luminance(truth, i));
    return sum;
  };
  EXPECT_LT(error(filtered), 0.6 * error(noisy));
  // The denoiser removes a little light with the outliers: it is for viewing, never for
  // measurements.
  EXPECT_NEAR(test::mean_luminance(filtered) / test::mean_luminance(noisy), 1, 0.08);
  EXPECT_EQ(filtered.info.estimator, "ris, denoised") << "a filtered picture says so";
}

TEST(Window, AMovingCameraKeepsTheMeanOfTheLastFramesWithoutBias) {
  const scene::RenderScene scene = test::random_town(6, 20, 3).with(test::random_lamps(30, 20, 4));
  gpu::Device& device = test::test_device();
  DeviceScene device_scene(device, scene);
  RenderSettings settings = reference();
  settings.sampling.estimator = Estimator::ris;
  settings.averaging.window = 8;
  const auto pose_at = [](int i) {
    return scene::CameraPose{
        {-20 + 0.1f * float(i), 14, 25}, {0.1f * float(i), 2, 0}, {0, 1, 0}, 50};
  };
  Renderer with(device, test::test_passes(), device_scene, 48, 36),
      without(device, test::test_passes(), device_scene, 48, 36);
  for (int i = 0; i <= 12; ++i) {
    settings.averaging.window = 8;
    with.render_frame(pose_at(i), settings);
    settings.averaging.window = 0;
    without.render_frame(pose_at(i), settings);
  }
  const measure::Image truth = render(scene, pose_at(12), reference(), 48, 36, 8);
  const auto error = [&](const measure::Image& image) {
    double sum = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i)
      sum += std::abs(test::luminance(image, i) - test::luminance(truth, i));
    return sum;
  };
  EXPECT_LT(error(with.download(false)), 0.75 * error(without.download(false)));
  EXPECT_NEAR(test::mean_luminance(with.download(false)) / test::mean_luminance(truth), 1, 0.05);
}

}  // namespace
}  // namespace nightcity::render
