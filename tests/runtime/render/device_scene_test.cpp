// Tests which lights of a scene on the device shine as time passes.
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>

#include "formats/error.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

constexpr double hour_s = 3600;

// Two lamps, of which the second shines from 20:00 to 23:00.
scene::RenderScene two_lamps(bool with_wall = false) {
  scene::SceneLights lights;
  lights.lights = {lamp({-4, 6, 0}, 3000), lamp({4, 6, 0}, 3000)};
  lights.lights[1].schedule = 0;
  lights.schedules = {{0, 2}};
  lights.switches = {8 * 3600, 11 * 3600};
  SceneBuilder builder = SceneBuilder().ground(30);
  if (with_wall) builder.box({-8, 0, -4}, {8, 8, -3});
  return scene::make_render_scene(builder.scene(), std::move(lights));
}

double brightness(render::DeviceScene& scene, double time_s) {
  render::RenderSettings settings;
  settings.sampling.estimator = render::Estimator::reference;
  settings.time_s = time_s;
  render::Renderer renderer(test_device(), test_passes(), scene, 16, 12);
  renderer.render_frame({{0, 15, 10}, {0, 0, 0}, {0, 1, 0}, 60}, settings);
  return mean_luminance(renderer.download(false));
}

TEST(DeviceScene, LightsSwitchAtOnceByTheirSchedules) {
  const scene::RenderScene scene = two_lamps();
  render::DeviceScene on_device(test_device(), scene);
  const double one = brightness(on_device, 7 * hour_s), both = brightness(on_device, 9 * hour_s);
  EXPECT_EQ(on_device.buffers().lit_count, 2u);
  EXPECT_NEAR(both / one, 2, 0.02);
  EXPECT_FALSE(on_device.set_time(10 * hour_s));
  EXPECT_TRUE(on_device.set_time(12 * hour_s));
  EXPECT_EQ(on_device.buffers().lit_count, 1u);
}

// No step of the clock is too small for a switch, in either direction, nor too large.
TEST(DeviceScene, LightsSwitchInTheStepInWhichTheyAreToSwitch) {
  const scene::RenderScene scene = two_lamps();  // the second from 8 to 11 hours after noon
  render::DeviceScene on_device(test_device(), scene, {7 * hour_s});
  const auto expect_lit = [&](double time_s, std::uint32_t lit, bool changes) {
    EXPECT_EQ(on_device.set_time(time_s), changes) << time_s;
    EXPECT_EQ(on_device.buffers().lit_count, lit) << time_s;
  };
  expect_lit(8 * hour_s - 0.01, 1, false);
  expect_lit(8 * hour_s, 2, true);
  expect_lit(8 * hour_s - 0.01, 1, true);
  expect_lit(10 * hour_s, 2, true);
  expect_lit(34 * hour_s, 2, false);  // a day later
  expect_lit(36 * hour_s, 1, true);
  expect_lit(31 * hour_s, 1, false);
}

TEST(DeviceScene, BeginsWithTheLightsOfTheTimeThatItIsTold) {
  scene::RenderScene scene = two_lamps();
  scene.families = {LightFamily::lamp, LightFamily::window};
  render::DeviceScene both(test_device(), scene, {9 * hour_s}),
      one(test_device(), scene, {9 * hour_s, scene::to_set(LightFamily::lamp)});
  EXPECT_EQ(both.buffers().lit_count, 2u);
  EXPECT_EQ(one.buffers().lit_count, 1u);
  EXPECT_FALSE(both.set_time(9 * hour_s)) << "its tables are made";
  EXPECT_FALSE(one.set_time(9 * hour_s, scene::to_set(LightFamily::lamp)));
  EXPECT_EQ(both.light_changes(), 0u);
  EXPECT_TRUE(one.set_time(9 * hour_s));
  EXPECT_EQ(brightness(one, 9 * hour_s), brightness(both, 9 * hour_s));
}

// A white and a blue lamp of the same flux send their light upwards; 0.5 cd/m^2 of 2 are the sky's
// own. So without the blue one the glow has half its red and green, and none of its blue.
TEST(DeviceScene, TheSkyOfACityFollowsTheLightsThatShine) {
  scene::RenderScene scene = two_lamps();
  scene.sky_map = {1, 2, {2, 2, 2, 0, 0, 0}, {{0, {0.5f, 0.5f, 0}}, {1, {0.5f, 0.5f, 1}}}};
  scene.sky_map.upward_lm = glm::dvec3(3000);
  scene.sky_map.natural_cd_m2 = 0.5f;
  render::DeviceScene on_device(test_device(), scene);
  render::RenderSettings settings;
  settings.sampling.estimator = render::Estimator::reference;
  settings.environment.sky_cd_m2 = glm::vec3(1);
  // The camera stands beside the ground.
  const auto expect_sky = [&](double time_s, float up, const glm::vec3& expected) {
    settings.time_s = time_s;
    render::Renderer renderer(test_device(), test_passes(), on_device, 8, 8);
    renderer.render_frame({{100, 2, 0}, {101, 2 + up, 0}, {0, 0, 1}, 10}, settings);
    const measure::Image image = renderer.download(false);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(image.rgb[c], expected[int(c)], 1e-5f) << time_s << " " << up << " " << c;
  };
  expect_sky(9 * hour_s, 1, {2, 2, 2});
  expect_sky(7 * hour_s, 1, {1.25f, 1.25f, 0.5f});
  expect_sky(7 * hour_s, -1, {0, 0, 0});
  // The window dims the white lamp.
  Light dimmed = scene.lights[0];
  dimmed.flux_lm *= 0.5f;
  on_device.edit_light(0, dimmed);
  expect_sky(9 * hour_s, 1, {1.625f, 1.625f, 2});
}

TEST(DeviceScene, APictureSaysWhatIsNotAsByDefault) {
  const scene::RenderScene scene = two_lamps();
  render::DeviceScene on_device(test_device(), scene);
  render::RenderSettings settings;
  const auto info_of = [&] {
    render::Renderer renderer(test_device(), test_passes(), on_device, 4, 4);
    renderer.render_frame({{0, 15, 10}, {0, 0, 0}, {0, 1, 0}, 60}, settings);
    return renderer.download(false).info.settings;
  };
  EXPECT_EQ(info_of(), "");
  settings.environment.wetness = 0.5f;
  settings.environment.lights = scene::parse_families("lamp");
  settings.projection = PROJECTION_FISHEYE;
  EXPECT_EQ(info_of(), "wet=0.5 projection=fisheye lights=lamp");
  on_device.edit_light(0, scene.lights[0]);
  EXPECT_EQ(info_of(), "wet=0.5 projection=fisheye lights=lamp, edited lights");
}

TEST(DeviceScene, WhereNobodyWaitsLightsSwitchOnceTheirTablesAreMade) {
  const scene::RenderScene scene = two_lamps();
  render::DeviceScene on_device(test_device(), scene);
  on_device.switch_when_ready();
  EXPECT_FALSE(on_device.set_time(9 * hour_s));
  EXPECT_TRUE(on_device.switching());
  EXPECT_EQ(on_device.buffers().lit_count, 1u);
  const auto start = std::chrono::steady_clock::now();
  while (!on_device.set_time(9 * hour_s)) {
    ASSERT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_FALSE(on_device.switching());
  EXPECT_EQ(on_device.buffers().lit_count, 2u);
  render::DeviceScene at_once(test_device(), scene);
  EXPECT_EQ(brightness(on_device, 9 * hour_s), brightness(at_once, 9 * hour_s));
  EXPECT_FALSE(on_device.set_time(12 * hour_s));  // and goes while the next tables are being made
}

// The first lamp is a lamp, the second one stands for a window.
TEST(DeviceScene, FamiliesThatAreOffDoNotShineWhateverTheirSchedules) {
  scene::RenderScene scene = two_lamps();
  scene.families = {LightFamily::lamp, LightFamily::window};
  render::DeviceScene on_device(test_device(), scene);
  const auto mean = [&](const char* lights, render::Estimator estimator) {
    render::RenderSettings settings;
    settings.sampling.estimator = estimator;
    settings.time_s = 9 * hour_s;
    settings.environment.lights = scene::parse_families(lights);
    render::Renderer renderer(test_device(), test_passes(), on_device, 16, 12);
    for (int i = 0; i < 64; ++i)
      renderer.render_frame({{0, 15, 10}, {0, 0, 0}, {0, 1, 0}, 60}, settings);
    return mean_luminance(renderer.download(false));
  };
  for (const auto estimator : {render::Estimator::reference, render::Estimator::traced}) {
    const double all = mean("all", estimator), lamps = mean("lamp,headlamp", estimator),
                 windows = mean("window", estimator);
    EXPECT_NEAR((lamps + windows) / all, 1, 0.02);
    EXPECT_NEAR(lamps / windows, 1, 0.02);  // they stand symmetrically
    EXPECT_EQ(mean("none", estimator), 0);
    EXPECT_EQ(mean("other", estimator), 0);
  }
}

TEST(DeviceScene, AnEditedLightShinesAsItWasEditedAndNothingOfItsPastStays) {
  const scene::RenderScene scene = two_lamps();
  render::DeviceScene on_device(test_device(), scene);
  render::RenderSettings settings;
  settings.time_s = 7 * hour_s;  // the first alone
  settings.indirect.bounces = 2;
  render::Renderer renderer(test_device(), test_passes(), on_device, 16, 12);
  const auto mean = [&] {
    for (int i = 0; i < 32; ++i)
      renderer.render_frame({{0, 15, 10}, {0, 0, 0}, {0, 1, 0}, 60}, settings);
    return mean_luminance(renderer.download(false));
  };
  const double before = mean();
  Light dimmed = scene.lights[0];
  dimmed.flux_lm /= 4;
  on_device.edit_light(0, dimmed);
  EXPECT_TRUE(on_device.switching());
  EXPECT_NEAR(mean() / before, 0.25, 0.01);
  EXPECT_EQ(renderer.frames(), 32u);  // the mean began anew
  dimmed.flux_lm = 0;
  on_device.edit_light(0, dimmed);
  EXPECT_EQ(mean(), 0);
  on_device.edit_light(0, scene.lights[0]);
  on_device.edit_light(7, scene.lights[0]);  // there is none
  EXPECT_NEAR(mean() / before, 1, 0.01);
}

// The second lamp goes out while the clock stands, because its tables took a moment: what it gave
// by bounces goes with it.
TEST(DeviceScene, LightThatBouncedGoesOutWithItsLamp) {
  const scene::RenderScene scene = two_lamps(true);
  const auto mean = [&](render::DeviceScene& on_device, double first_s) {
    render::Renderer renderer(test_device(), test_passes(), on_device, 16, 12);
    render::RenderSettings settings;
    settings.indirect.bounces = 4;
    for (const double time_s : {first_s, 12 * hour_s}) {
      settings.time_s = time_s;
      for (int i = 0; i < 64; ++i)
        renderer.render_frame({{0, 15, 10}, {0, 0, 0}, {0, 1, 0}, 60}, settings);
      while (on_device.switching())
        renderer.render_frame({{0, 15, 10}, {0, 0, 0}, {0, 1, 0}, 60}, settings);
    }
    for (int i = 0; i < 32; ++i)
      renderer.render_frame({{0, 15, 10}, {0, 0, 0}, {0, 1, 0}, 60}, settings);
    return mean_luminance(renderer.download(false));
  };
  render::DeviceScene waiting(test_device(), scene), at_once(test_device(), scene);
  waiting.switch_when_ready();
  EXPECT_NEAR(mean(waiting, 9 * hour_s) / mean(at_once, 12 * hour_s), 1, 0.02);
}

// One renderer sits out two switches that the other one makes.
TEST(DeviceScene, RenderersAtTimesOfTheirOwnShowTheLightsOfTheirOwnTime) {
  const scene::RenderScene scene = two_lamps();
  render::DeviceScene on_device(test_device(), scene);
  render::Renderer one(test_device(), test_passes(), on_device, 16, 12),
      both(test_device(), test_passes(), on_device, 16, 12);
  const auto mean = [&](render::Renderer& renderer, double time_s) {
    render::RenderSettings settings;
    settings.time_s = time_s;
    for (int i = 0; i < 64; ++i)
      renderer.render_frame({{0, 15, 10}, {0, 0, 0}, {0, 1, 0}, 60}, settings);
    return mean_luminance(renderer.download(false));
  };
  for (int round = 0; round < 3; ++round) {
    const double first = mean(one, 7 * hour_s);
    mean(both, 9 * hour_s);
    mean(both, 7 * hour_s);
    EXPECT_NEAR(mean(both, 9 * hour_s) / first, 2, 0.06);
  }
}

TEST(DeviceScene, GeometryCanBeReleasedOnceTheDeviceHasIt) {
  scene::RenderScene scene = two_lamps();
  render::DeviceScene kept(test_device(), scene);
  EXPECT_FALSE(scene.triangles.empty());
  render::DeviceScene released(test_device(), scene, render::ReleaseGeometry{});
  EXPECT_TRUE(scene.triangles.empty());
  EXPECT_TRUE(scene.triangle_order.empty());
  EXPECT_TRUE(scene.nodes.empty());
  EXPECT_TRUE(scene.instances.empty());
  EXPECT_EQ(scene.lights.size(), 2u);
  EXPECT_EQ(brightness(released, 9 * hour_s), brightness(kept, 9 * hour_s));
}

TEST(DeviceScene, BeyondTheDevicesMemoryTheErrorSaysHowMuchIsNeededAndFree) {
  gpu::Device::Options options;
  options.max_memory_bytes = 1 << 20;
  gpu::Device device(options);
  scene::RenderScene scene = two_lamps();
  while (scene.triangles.size() < 100'000) scene.triangles.push_back(scene.triangles[0]);
  scene.triangle_order.resize(100'000, 0);  // which the device holds
  try {
    const render::DeviceScene on_device(device, scene, render::ReleaseGeometry{});
    FAIL() << "allocated";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("needs at least 48"), std::string::npos) << text;
    EXPECT_NE(text.find(" 1048576 are free"), std::string::npos) << text;
  }
  EXPECT_EQ(scene.triangles.size(), 100'000u);
}

}  // namespace
}  // namespace nightcity::test
