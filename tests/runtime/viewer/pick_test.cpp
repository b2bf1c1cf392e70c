#include "runtime/viewer/pick.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "runtime/scene/point_light.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::viewer {
namespace {

constexpr double pi = std::numbers::pi;
const glm::dvec3 up(0, 1, 0);

TEST(LightAtAPoint, OfALampIsItsIntensityByTheSquareOfTheDistance) {
  const scene::RenderScene scene =
      test::SceneBuilder().ground(50).with({test::lamp({0, 8, 0}, 5000)});
  const auto below = scene::find_light_at(scene, {0, 0, 0}, up, 0, 10);
  EXPECT_NEAR(below.lux, 5000 / (4 * pi) / 64, 1e-3);
  ASSERT_EQ(below.strongest.size(), 1u);
  EXPECT_NEAR(below.strongest[0].distance_m, 8, 1e-4);
  // The cosine to the third power of the height, 6 m to the side.
  const auto aside = scene::find_light_at(scene, {6, 0, 0}, up, 0, 10);
  EXPECT_NEAR(aside.lux, 5000 / (4 * pi) * 8 / 1000, 1e-3);
  EXPECT_EQ(scene::find_light_at(scene, {0, 9, 0}, up, 0, 10).lux, 0);  // above, facing away
}

// A square window of half side a, straight ahead at distance d of a parallel surface: the form
// factor of parallel rectangles, by corners (Howell, A Catalog of Radiation Heat Transfer
// Configuration Factors, B-3).
TEST(LightAtAPoint, OfAWindowIsItsFormFactorNearAndFar) {
  const double a = 0.5, flux = 300, radiance = flux / (pi * 4 * a * a);
  for (const double d : {0.5, 2.0, 30.0}) {
    const scene::RenderScene scene = test::SceneBuilder().ground(1, -90).with(
        {test::window({0, 5, 0}, {0, 0, 1}, 0.5f, 0.5f, 300)});
    const double x = a / d, corner = std::atan(x / std::sqrt(1 + x * x)) * x /
                                     std::sqrt(1 + x * x) * 2 / (2 * pi);
    const double expected = pi * radiance * 4 * corner;
    const double found = scene::illuminance_of(scene, scene.lights[0], {0, 5, d}, {0, 0, -1});
    EXPECT_NEAR(found / expected, 1, 0.01) << d;
    EXPECT_EQ(scene::illuminance_of(scene, scene.lights[0], {0, 5, -d}, {0, 0, 1}), 0);
  }
}

TEST(LightAtAPoint, ShadowsAndTheStrongestOfManyInOrder) {
  std::vector<Light> lamps;
  for (int i = 0; i < 30; ++i) lamps.push_back(test::lamp({3.0f * float(i), 6, 10}, 1000));
  lamps.push_back(test::lamp({0, 6, -10}, 50000));  // behind a wall
  const scene::RenderScene scene =
      test::SceneBuilder().ground(200).box({-50, 0, -6}, {50, 20, -5}).with(lamps);
  const auto light = scene::find_light_at(scene, {0, 0, 0}, up, 0, 10);
  ASSERT_EQ(light.strongest.size(), 10u);
  double sum = 0;
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(light.strongest[i].light, i);
    if (i > 0) {
      EXPECT_LE(light.strongest[i].lux, light.strongest[i - 1].lux);
    }
    sum += light.strongest[i].lux;
  }
  EXPECT_GT(light.lux, sum);
  EXPECT_LE(light.lit, 30u);
}

TEST(LightAtAPoint, LightsThatAreSwitchedOffGiveNone) {
  Scene geometry = test::SceneBuilder().ground(50).scene();
  scene::SceneLights lights;
  lights.lights = {test::lamp({0, 8, 0}, 5000)};
  lights.lights[0].schedule = 0;
  lights.schedules = {Schedule{}};
  const auto at = [&](bool on) {
    scene::SceneLights switched = lights;
    switched.schedules[0] = Schedule{0, 2};
    switched.switches =
        on ? std::vector<std::uint32_t>{18000, 60000} : std::vector<std::uint32_t>{50000, 60000};
    const scene::RenderScene scene = scene::make_render_scene(geometry, std::move(switched));
    return scene::find_light_at(scene, {0, 0, 0}, up, 30000, 10).lux;
  };
  EXPECT_GT(at(true), 0);
  EXPECT_EQ(at(false), 0);
}

// The same point in the picture of the reference: illuminance is pi times luminance over albedo.
TEST(LightAtAPoint, IsWhatTheReferenceRenders) {
  std::vector<Light> lamps = test::random_lamps(30, 30, 3);
  for (Light& lamp : lamps) lamp.radius = 0.02f;
  const scene::RenderScene scene = test::random_town(12, 40, 4).with(lamps);
  const scene::CameraPose pose{{0, 60, 0.1f}, {0, 0, 0}, {0, 0, -1}, 50};
  render::RenderSettings settings;
  settings.sampling.estimator = render::Estimator::reference;
  settings.sampling.jitter = false;
  const measure::Image image = test::render(scene, pose, settings, 21, 21, 4);
  int compared = 0;
  for (std::uint32_t y = 1; y < 21; y += 4)
    for (std::uint32_t x = 1; x < 21; x += 4) {
      const auto picked = pick(scene, pose, {float(x) + 0.5f, float(y) + 0.5f}, {21, 21}, 0);
      if (!picked || picked->lux < 0.01) continue;
      const double rendered = pi * test::luminance(image, y * 21 + x) / 0.5;
      EXPECT_NEAR(picked->lux / rendered, 1, 0.02) << x << ' ' << y;
      ++compared;
    }
  EXPECT_GT(compared, 10);
}

TEST(Picking, TellsObjectPlaceLightAndSources) {
  scene::RenderScene scene = test::SceneBuilder().ground(50).with({test::lamp({0, 8, 0}, 5000)});
  for (gpu::Triangle& triangle : scene.triangles.stored()) triangle.feature = 0;
  SceneFeature building{"DEB_1234", "Building", "1000", 12.5, 4};
  scene.features = {building};
  LightProvenance provenance;
  provenance.position = ValueSource::tag;
  provenance.flux = ValueSource::standard;
  provenance.source_id = 77;
  scene.provenance = {provenance};
  scene.georeference.crs = "EPSG:25833";
  scene.georeference.origin = {390000, 5819000, 34};
  const scene::CameraPose pose{{0, 10, 10}, {0, 0, 0}, {0, 1, 0}, 50};
  const auto picked = pick(scene, pose, {640, 360}, {1280, 720}, 0);
  ASSERT_TRUE(picked);
  EXPECT_LT(glm::length(picked->point), 1e-3f);
  std::string text;
  for (const std::string& line : picked->lines) text += line + "\n";
  for (const char* part : {"Building DEB_1234", "1000", "12.5 m", "4 storeys", "390000.0 E",
                           "5819000.0 N", "34.0 m", "EPSG:25833", "14.1 m from the camera"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  ASSERT_EQ(picked->strongest.size(), 1u);
  EXPECT_NEAR(picked->strongest[0].share, 1, 1e-9);
  EXPECT_NE(picked->strongest[0].name.find("5000 lm"), std::string::npos);
  for (const char* part : {"position: tag", "flux: standard", "source 77"})
    EXPECT_NE(picked->strongest[0].sources.find(part), std::string::npos) << part;
  EXPECT_FALSE(pick(scene, pose, {640, -4000}, {1280, 720}, 0));  // the sky
}

}  // namespace
}  // namespace nightcity::viewer
