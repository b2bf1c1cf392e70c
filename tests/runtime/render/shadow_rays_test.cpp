// The number of shadow rays that an estimator casts, which decides what a frame costs.
#include <gtest/gtest.h>

#include "support/estimators.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

constexpr std::uint32_t side = 48;
constexpr double pixels = double(side) * side;

// Every pixel sees the ground, and the lamp lights all of it: no ray can be saved.
class ShadowRays : public testing::Test {
 protected:
  double per_pixel(const render::RenderSettings& settings, int frames) {
    render::Renderer renderer(test_device(), test_passes(), device_scene_, side, side);
    for (int i = 0; i < frames; ++i)
      renderer.render_frame({{0, 30, 0}, {0, 0, 0}, {0, 0, -1}, 40}, settings);
    picture_ = renderer.download(false);
    return double(renderer.shadow_rays()) / pixels;
  }
  static render::RenderSettings counted(render::Estimator estimator) {
    render::RenderSettings settings = with_estimator(estimator);
    settings.count_rays = true;
    return settings;
  }
  scene::RenderScene scene_ = SceneBuilder().ground(100).with({lamp({0, 8, 0}, 5000)});
  render::DeviceScene device_scene_{test_device(), scene_};
  measure::Image picture_;
};

TEST_F(ShadowRays, TheDefaultCastsFiveAtMost) {
  const render::RenderSettings settings = counted(render::RenderSettings{}.sampling.estimator);
  const double partners = settings.reuse.neighbours;
  const double first = per_pixel(settings, 1), later = per_pixel(settings, 3);
  EXPECT_LE(later, 5.0);
  EXPECT_LE(first, 1 + partners);
  EXPECT_LE(later, 3 + partners);
  // Partners outside the picture are missing at its border.
  EXPECT_GT(first, 1 + 0.8 * partners);
  EXPECT_GT(later, 3 + 0.8 * partners);
}

// Around a lit square the ground is nearly black: most samples there are dropped before their rays.
TEST(Roulette, SavesRaysWhereThePictureIsNearlyBlack) {
  std::vector<Light> lamps;
  for (int i = 0; i < 400; ++i)
    lamps.push_back(lamp({float(i % 20) * 30 - 285, 8, float(i / 20) * 30 - 285}, 5000));
  const scene::RenderScene scene = SceneBuilder().ground(2000).with(lamps);
  render::DeviceScene device_scene(test_device(), scene);
  const auto rays_per_pixel = [&](float steps) {
    render::RenderSettings settings = with_estimator(render::Estimator::traced);
    settings.count_rays = true;
    settings.sampling.roulette_steps = steps;
    render::Renderer renderer(test_device(), test_passes(), device_scene, side, side);
    for (int i = 0; i < 3; ++i)
      renderer.render_frame({{0, 1000, 0}, {0, 0, 0}, {0, 0, -1}, 90}, settings);
    return double(renderer.shadow_rays()) / pixels;
  };
  const double all = rays_per_pixel(0), some = rays_per_pixel(1);
  EXPECT_GT(all, 6.0 / 7 * (3 + render::RenderSettings{}.reuse.neighbours));
  EXPECT_LT(some, 0.5 * all);
  EXPECT_GT(some, 0.1 * all);  // those of the lit square, a tenth of the picture
}

TEST_F(ShadowRays, WithoutShadowedTargetsThereIsOne) {
  for (const render::Estimator estimator :
       {render::Estimator::ris, render::Estimator::basic, render::Estimator::pairwise})
    EXPECT_EQ(per_pixel(counted(estimator), 3), 1.0) << render::name_of(estimator);
}

TEST_F(ShadowRays, CountingThemChangesNothingElse) {
  render::RenderSettings settings = counted(render::Estimator::traced);
  EXPECT_GT(per_pixel(settings, 2), 0.0);
  const measure::Image counted_picture = picture_;
  settings.count_rays = false;
  EXPECT_EQ(per_pixel(settings, 2), 0.0);
  if (test_device().info().kind == "cpu") {
    EXPECT_EQ(picture_.rgb, counted_picture.rgb);
  }
}

}  // namespace
}  // namespace nightcity::test
