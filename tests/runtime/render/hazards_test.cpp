// Extreme numbers: every pixel stays finite, and no hazard costs light.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

void expect_all_finite(const measure::Image& image) {
  for (const float value : image.rgb) ASSERT_TRUE(std::isfinite(value) && value >= 0) << value;
}

class Hazard : public testing::TestWithParam<render::EstimatorTraits> {
 protected:
  render::RenderSettings settings() const {
    render::RenderSettings s;
    s.sampling.estimator = GetParam().estimator;
    s.sampling.candidates = 4;
    return s;
  }
};

TEST_P(Hazard, ALampThatTouchesTheGroundStaysFinite) {
  const scene::RenderScene scene =
      SceneBuilder().ground(100).with({lamp({0, 0, 0}, 5000, 0), lamp({1, 0.0005f, 1}, 5000, 0)});
  expect_all_finite(render(scene, looking_down, settings(), 33, 33, 3));
}

TEST_P(Hazard, FluxesAcrossThirtyOrdersOfMagnitudeStayFinite) {
  const scene::RenderScene scene = SceneBuilder().ground(100).with(
      {lamp({0, 5, 0}, 1e-12f), lamp({2, 5, 0}, 1e20f), lamp({-2, 5, 0}, 5e3f)});
  const measure::Image image = render(scene, looking_down, settings(), 16, 16, 3);
  expect_all_finite(image);
  EXPECT_GT(mean_luminance(image), 1e10);
}

TEST_P(Hazard, LightsThatAreNotFiniteAreSwitchedOffAndCounted) {
  std::vector<Light> lights{lamp({0, 5, 0}, 5000), lamp({1, 5, 0}, 5000), lamp({2, 5, 0}, 5000),
                            lamp({3, 5, 0}, 5000)};
  lights[1].position.x = std::numeric_limits<float>::quiet_NaN();
  lights[2].flux_lm = std::numeric_limits<float>::infinity();
  lights[3].kind_profile = pack_kind_profile(LightKind::sphere, 77);  // no such profile
  const scene::RenderScene scene = SceneBuilder().ground(100).with(lights);
  EXPECT_EQ(scene.bad_lights, 3u);
  render::RenderSettings s = settings();
  s.sampling.candidates = 64;
  const measure::Image image = render(scene, looking_down, s, 16, 16, 4);
  expect_all_finite(image);
  const double good = mean_luminance(
      render(SceneBuilder().ground(100).with({lights[0]}), looking_down, s, 16, 16, 4));
  EXPECT_NEAR(mean_luminance(image) / good, 1.0, 0.05);
}

TEST_P(Hazard, AWindowWithoutAreaStaysFinite) {
  const scene::RenderScene scene = SceneBuilder().ground(100).with(
      {window({0, 4, -3}, {0, 0, 1}, 0, 0, 100), window({0, 4, -3}, {0, 0, 1}, 1, 0, 100)});
  expect_all_finite(render(scene, looking_down, settings(), 16, 16, 3));
}

TEST_P(Hazard, SliverAndZeroAreaTrianglesNeitherBlockNorBreak) {
  SceneBuilder builder;
  builder.ground(100);
  builder.quad({-50, 4, 0}, {50, 4, 0}, {50, 4, 0}, {-50, 4, 0});          // no area
  builder.quad({-50, 4, 0}, {50, 4, 0}, {50, 4, 1e-6f}, {-50, 4, 1e-6f});  // 100 m by 1 um
  const scene::RenderScene scene = builder.with({lamp({0, 8, 0}, 5000)});
  EXPECT_GE(scene.dropped_triangles, 2u);
  const measure::Image image = render(scene, looking_down, settings(), 16, 16, 3);
  expect_all_finite(image);
  EXPECT_GT(mean_luminance(image), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Ladder, Hazard, testing::ValuesIn(render::list_estimators()),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

}  // namespace
}  // namespace nightcity::test
