// Ray queries and ray tracing pipelines against our own traversal, on devices that have them.
// NIGHTCITY_TEST_TRACE=query and =pipeline run all tests of the renderer with them.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "formats/error.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

using gpu::Trace;

gpu::Device::Options by(Trace trace) {
  gpu::Device::Options options;
  options.select = test_device().info().name;
  options.trace = trace;
  return options;
}

class TraceWays : public ::testing::TestWithParam<Trace> {};

TEST_P(TraceWays, AreRefusedWhereTheDeviceLacksThem) {
  if (has(test_device().info(), GetParam())) GTEST_SKIP() << "this device has it";
  EXPECT_THROW(gpu::Device{by(GetParam())}, UsageError);
}

// Houses, 40 instances of a post, a glass that casts no shadow, and a vehicle that drives past
// them.
scene::RenderScene street() {
  SceneBuilder builder = random_town(40, 50, 5), post, glass;
  post.box({-0.5f, 0, -0.5f}, {0.5f, 4, 0.5f});
  glass.quad({-4, 9, -4}, {-4, 9, 4}, {4, 9, 4}, {4, 9, -4});
  Scene& scene = builder.scene();
  scene.meshes.push_back(post.scene().meshes[0]);
  scene.meshes.push_back(glass.scene().meshes[0]);
  SceneNode posts{"posts", "lamp", 1, true, {}};
  for (int i = 0; i < 40; ++i) {
    const glm::mat4 place =
        glm::translate(glm::mat4(1.0f), glm::vec3(float(i % 8) * 9 - 31, 0, float(i / 8) * 9 - 18));
    posts.instances.push_back({glm::rotate(place, float(i), glm::vec3(0, 1, 0)), no_id});
  }
  scene.nodes.push_back(posts);
  scene.nodes.push_back({"glass", "lamp", 2, false, {SceneInstance{}}});
  scene::SceneLights lights;
  lights.lights = to_large(random_lamps(60, 50, 6));
  scene::Traffic& traffic = lights.traffic;
  traffic.cycle.cycle_s = 100;
  for (float& share : traffic.cycle.density) share = 1;
  traffic.vehicles = {{{2, 0.8f, 1}, 0, 0, {}}};
  traffic.knots = {{{-30, 0, 24}, 0, {6, 0, 0}, 0}, {{30, 0, 24}, 10, {6, 0, 0}, 0}};
  traffic.trips = {{0, 2, 0, 0, 0, 0, {}}};
  return scene::make_render_scene(scene, std::move(lights));
}

measure::Image seen_by(gpu::Device& device, const scene::RenderScene& scene,
                       render::Estimator estimator, std::uint32_t frames) {
  render::RenderSettings settings;
  settings.sampling.estimator = estimator;
  settings.sampling.jitter = false;
  settings.sampling.layers = true;
  render::PassLibrary passes(device);
  render::DeviceScene device_scene(device, scene);
  render::Renderer renderer(device, passes, device_scene, 160, 90);
  for (std::uint32_t i = 0; i < frames; ++i) {
    settings.time_s = 8 * 3600 + 5 + 0.05 * i;
    renderer.render_frame({{-45, 25, 60}, {0, 3, 10}, {0, 1, 0}, 50}, settings);
  }
  return renderer.download(true);
}

// Only rays that graze an edge may differ.
TEST_P(TraceWays, MeetTheSurfacesAndShadowsThatOurOwnTraversalMeets) {
  if (!has(test_device().info(), GetParam()))
    GTEST_SKIP() << test_device().info().name << " lacks it";
  gpu::Device other(by(GetParam())), compute(by(Trace::compute));
  const scene::RenderScene scene = street();
  for (const render::Estimator estimator :
       {render::Estimator::reference, render::Estimator::traced}) {
    const measure::Image a = seen_by(other, scene, estimator, 3),
                         b = seen_by(compute, scene, estimator, 3);
    int depths = 0, normals = 0, bright = 0;
    const auto differ = [](double x, double y) { return std::abs(x - y) > 1e-3 * std::abs(y); };
    for (std::size_t i = 0; i < a.pixels(); ++i) {
      depths += differ(double(a.layer("depth")->values[i]), double(b.layer("depth")->values[i]));
      for (std::size_t axis = 0; axis < 3; ++axis)
        normals += std::abs(a.layer("normal")->values[3 * i + axis] -
                            b.layer("normal")->values[3 * i + axis]) > 1e-3f;
      bright += differ(luminance(a, i), luminance(b, i));
    }
    EXPECT_LE(depths, 15) << render::name_of(estimator);  // a thousandth of the pixels
    EXPECT_LE(normals, 3 * 15) << render::name_of(estimator);
    if (estimator == render::Estimator::reference) {
      EXPECT_LE(bright, 150);  // 60 shadow rays each
    }
    EXPECT_NEAR(mean_luminance(a) / mean_luminance(b), 1, 1e-3) << render::name_of(estimator);
  }
}

INSTANTIATE_TEST_SUITE_P(All, TraceWays, ::testing::Values(Trace::query, Trace::pipeline),
                         [](const auto& info) { return gpu::name_of(info.param); });

}  // namespace
}  // namespace nightcity::test
