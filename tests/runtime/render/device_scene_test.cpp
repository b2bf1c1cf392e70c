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
scene::RenderScene two_lamps() {
  scene::SceneLights lights;
  lights.lights = {lamp({-4, 6, 0}, 3000), lamp({4, 6, 0}, 3000)};
  lights.lights[1].schedule = 0;
  lights.schedules = {{0, 2}};
  lights.switches = {8 * 3600, 11 * 3600};
  return scene::make_render_scene(SceneBuilder().ground(30).scene(), std::move(lights));
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
  scene.triangles.resize(100'000, scene.triangles.front());
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
