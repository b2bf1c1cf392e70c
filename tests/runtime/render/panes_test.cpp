// Windows show the camera a frame and a room of the same mean as their even light, and their glass
// mirrors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "formats/material_names.h"
#include "support/estimators.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

struct Pane {
  float half_width = 0.6f, half_height = 0.75f, flux_lm = 1000;
  std::uint32_t id = 1;
  const char* material = window_pane_material;
  bool is_off = false;
};

// A window in the plane z = 0 that faces +z, and nothing else.
Scene make_scene(const Pane& pane) {
  Scene scene = SceneBuilder(0).scene();
  scene.nodes.clear();
  scene.meshes.clear();
  scene.materials.push_back({pane.material, glm::vec3(0), glm::vec3(100), 0.1f, false});
  ScenePrimitive quad;
  const float w = pane.half_width, h = pane.half_height;
  quad.positions = {{-w, -h, 0}, {w, -h, 0}, {w, h, 0}, {-w, h, 0}};
  quad.indices = {0, 1, 2, 0, 2, 3};
  quad.light_ids.assign(4, 0);
  quad.material = 1;
  scene.meshes.push_back({"windows", {quad}});
  scene.nodes.push_back({"windows", "window", 0, false, {SceneInstance{}}});
  return scene;
}

measure::Image see(const Scene& scene, const Pane& pane, const glm::vec3& from, float fov_deg,
                   std::uint32_t side, render::Estimator estimator, float sky = 0,
                   bool jitter = false) {
  Light light = window({0, 0, 0}, {0, 0, 1}, pane.half_width, pane.half_height, pane.flux_lm);
  light.id = pane.id;
  render::RenderSettings settings = with_estimator(estimator, 4);
  settings.environment.sky_cd_m2 = glm::vec3(sky);
  settings.sampling.jitter = jitter;
  scene::SceneLights lights;
  if (pane.is_off) {
    light.schedule = 0;
    lights.schedules = {{0, 0}};  // never on
  }
  lights.lights = to_large({light});
  return render(scene::make_render_scene(scene, std::move(lights)),
                {from, {0, 0, 0}, {0, 1, 0}, fov_deg}, settings, side, side, jitter ? 64 : 16);
}

double sum_luminance(const measure::Image& image) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) sum += luminance(image, i);
  return sum;
}

// From far away all of a window is seen at nearly the same angle, so that pixels show equal areas.
TEST(Panes, KeepTheLuminanceOfTheirLightInTheMean) {
  for (const auto& [half_width, half_height] :
       {std::pair(0.6f, 0.75f), {0.3f, 0.25f}, {2.4f, 1.3f}, {0.065f, 0.4f}})
    for (const glm::vec3 from : {glm::vec3(0, 0, 1), glm::vec3(-1.6f, -0.3f, 1),
                                 glm::vec3(0.7f, -1, 1), glm::vec3(0.2f, 1.2f, 1)})
      for (const std::uint32_t id : {1u, 2u, 5u}) {
        Pane pane{half_width, half_height, 1000, id};
        const glm::vec3 at = 60.0f * glm::normalize(from);
        const float fov_deg = glm::degrees(2.6f * std::max(half_width, half_height) / 60);
        const measure::Image seen =
            see(make_scene(pane), pane, at, fov_deg, 32, render::Estimator::ris, 0, true);
        pane.material = even_window_material;
        const measure::Image even =
            see(make_scene(pane), pane, at, fov_deg, 32, render::Estimator::ris, 0, true);
        EXPECT_GT(sum_luminance(even), 500);
        EXPECT_NEAR(sum_luminance(seen) / sum_luminance(even), 1, 0.01)
            << half_width << " " << from.x << " " << from.y << " " << id;
      }
}

TEST(Panes, ShowAFrameThatIsDark) {
  Pane pane;
  for (const std::uint32_t id : {1u, 2u, 3u, 5u}) {
    pane.id = id;
    const measure::Image seen =
        see(make_scene(pane), pane, {0, 0, 30}, 2.2f, 64, render::Estimator::ris);
    pane.material = even_window_material;
    const double even = luminance(
        see(make_scene(pane), pane, {0, 0, 30}, 2.2f, 64, render::Estimator::ris), 32 * 64 + 32);
    pane.material = window_pane_material;
    // 0.6 m are 33 pixels of 64, so the outer 6 cm are three pixels wide.
    double darkest = 1e9, brightest = 0;
    for (std::size_t x = 0; x < 64; ++x) {
      darkest = std::min(darkest, luminance(seen, 40 * 64 + x));
      brightest = std::max(brightest, luminance(seen, 40 * 64 + x));
    }
    EXPECT_LT(darkest, 0.02 * even);
    EXPECT_GT(brightest, 1.1 * even) << "what the frame takes is in the glass";
  }
}

TEST(Panes, AreAsBrightFromWhereTheyAreSmallerThanAPixel) {
  Pane pane;
  const auto mean = [&](const char* material) {
    pane.material = material;
    return sum_luminance(
        see(make_scene(pane), pane, {50, 20, 300}, 4, 16, render::Estimator::ris, 0, true));
  };
  const double even = mean(even_window_material);
  EXPECT_GT(even, 1);
  EXPECT_NEAR(mean(window_pane_material) / even, 1, 0.03);
}

TEST(Panes, LookTheSameByEveryEstimator) {
  const Pane pane;
  const auto seen = [&](render::Estimator estimator) {
    return see(make_scene(pane), pane, {1, -1, 3}, 40, 48, estimator);
  };
  const measure::Image truth = seen(render::Estimator::reference),
                       traced = seen(render::Estimator::traced);
  double difference = 0;
  for (std::size_t i = 0; i < truth.pixels(); ++i)
    difference = std::max(difference, std::abs(luminance(truth, i) - luminance(traced, i)));
  EXPECT_GT(sum_luminance(truth), 100);
  EXPECT_LT(difference, 0.01);
}

// By Fresnel's equations as Schlick approximates them, for both faces of a pane of glass.
double reflectance_of_glass(double cosine) {
  const double face = 0.04 + 0.96 * std::pow(1 - cosine, 5);
  return 2 * face / (1 + face);
}

TEST(Panes, MirrorWhatShinesAndTheSkyWhereTheyAreDark) {
  Pane pane{0.55f, 0.75f, 1000, 1, window_pane_material, true};  // one field of glass
  Scene scene = make_scene(pane);
  scene.materials.push_back({"glow", glm::vec3(0), glm::vec3(50), 1.0f, true});
  ScenePrimitive glow;
  glow.positions = {{2, -1, 4}, {4, -1, 4}, {4, 1, 4}, {2, 1, 4}};
  glow.indices = {0, 1, 2, 0, 2, 3};
  glow.material = 2;
  scene.meshes.push_back({"glow", {glow}});
  scene.nodes.push_back({"glow", "sign", 1, false, {SceneInstance{}}});
  for (const render::Estimator estimator : {render::Estimator::ris, render::Estimator::reference}) {
    const measure::Image seen = see(scene, pane, {-3, 0, 4}, 4, 9, estimator);
    EXPECT_NEAR(luminance(seen, 40), 50 * reflectance_of_glass(0.8), 0.05);
    const measure::Image sky = see(scene, pane, {-1.5f, 0, 0.5f}, 4, 9, estimator, 2);
    EXPECT_NEAR(luminance(sky, 40), 2 * reflectance_of_glass(0.5 / std::sqrt(2.5)), 0.02);
  }
  pane.material = even_window_material;
  const measure::Image even =
      see(make_scene(pane), pane, {-1.5f, 0, 0.5f}, 4, 9, render::Estimator::ris, 2);
  EXPECT_NEAR(luminance(even, 40), 0, 1e-3);
}

}  // namespace
}  // namespace nightcity::test
