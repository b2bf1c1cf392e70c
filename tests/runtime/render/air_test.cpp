// Light that air scatters once, against closed forms and quadrature.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "formats/error.h"
#include "runtime/render/setting_table.h"
#include "support/estimators.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

using std::numbers::pi;

render::RenderSettings in_air(render::Estimator estimator, float visibility_km,
                              float asymmetry = 0) {
  render::RenderSettings settings = with_estimator(estimator);
  settings.air.visibility_km = visibility_km;
  settings.air.asymmetry = asymmetry;
  return settings;
}

// Returns the integral of f over [from, to] by Simpson's rule with an even number of steps.
double integrate(double from, double to, int steps, const std::function<double(double)>& f) {
  const double h = (to - from) / steps;
  double sum = f(from) + f(to);
  for (int i = 1; i < steps; ++i) sum += f(from + i * h) * (i % 2 == 1 ? 4 : 2);
  return sum * h / 3;
}

// The eye looks along a ray through empty air.
struct EyeRay {
  glm::dvec3 origin, direction;
};

std::vector<EyeRay> rays_of(const scene::CameraPose& pose, int side) {
  const glm::dvec3 forward = glm::normalize(glm::dvec3(pose.target) - glm::dvec3(pose.position));
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(pose.up)));
  const glm::dvec3 up = glm::cross(right, forward);
  const double half = std::tan(double(pose.fov_deg) / 2 * pi / 180);
  std::vector<EyeRay> rays;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double sx = 2 * (x + 0.5) / side - 1, sy = 1 - 2 * (y + 0.5) / side;
      rays.push_back({glm::dvec3(pose.position),
                      glm::normalize(forward + right * (sx * half) + up * (sy * half))});
    }
  return rays;
}

class AirOf : public testing::TestWithParam<render::EstimatorTraits> {};

// A lamp of intensity I at a distance h beside the ray, in air so thin that it takes nothing: the
// air scatters beta / (4 pi) I integral dt / (h^2 + t^2), which is beta I (b - a) / (4 pi h), with
// the angles a and b at which the lamp sees the two ends of the ray.
TEST_P(AirOf, ThinAirGlowsByTheAngleAtWhichALampSeesTheRay) {
  constexpr float flux = 1e6f, visibility_km = 10'000;
  const glm::dvec3 lamp_at(3, 2, -20);
  const scene::RenderScene scene =
      SceneBuilder(0.f).ground(1, -1).with({lamp(glm::vec3(lamp_at), flux, 0.01f)});
  const scene::CameraPose pose{{0, 0.5f, 0}, {0, 4, -20}, {0, 1, 0}, 20};
  const measure::Image image =
      render(scene, pose, in_air(GetParam().estimator, visibility_km), 8, 8, 128);
  const double beta = 3.912 / (1000.0 * double(visibility_km));
  const auto rays = rays_of(pose, 8);
  double sum = 0, expected_sum = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    const glm::dvec3 way = lamp_at - rays[i].origin;
    const double nearest = glm::dot(way, rays[i].direction);
    const double h = glm::length(way - rays[i].direction * nearest);
    const double angle = pi / 2 - std::atan2(-nearest, h);
    const double expected = beta * double(flux) / (4 * pi) * angle / (4 * pi * h);
    EXPECT_NEAR(luminance(image, i), expected, 0.01 * expected) << "pixel " << i;
    sum += luminance(image, i);
    expected_sum += expected;
  }
  EXPECT_NEAR(sum / expected_sum, 1, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Air, AirOf, testing::ValuesIn(render::list_estimators()),
                         [](const auto& info) { return std::string(info.param.name); });

double henyey_greenstein(double g, double cosine) {
  return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

// Returns what the air on a ray scatters of one point lamp of intensity `candela`, in air that
// takes beta at y = 0 and `falloff` times as much less with each m of height. The integrals are
// this test's own.
double scattered_by_quadrature(const EyeRay& ray, const glm::dvec3& lamp_at, double candela,
                               double beta, double falloff, double g, double albedo, double depth) {
  const auto depth_between = [&](const glm::dvec3& a, const glm::dvec3& b) {
    return glm::length(b - a) * integrate(0, 1, 32, [&](double s) {
             return beta * std::exp(-falloff * (a.y + (b.y - a.y) * s));
           });
  };
  return integrate(0, depth, 4000, [&](double t) {
    const glm::dvec3 place = ray.origin + ray.direction * t, to_lamp = lamp_at - place;
    const double d2 = glm::dot(to_lamp, to_lamp);
    return albedo * beta * std::exp(-falloff * place.y) * candela / d2 *
           henyey_greenstein(g, glm::dot(glm::normalize(to_lamp), ray.direction)) *
           std::exp(-depth_between(ray.origin, place) - depth_between(place, lamp_at));
  });
}

// One lamp in fog that takes light on both ways, over a black ground that ends the rays.
void expect_quadrature(render::AirSettings air, double tolerance) {
  constexpr float flux = 1e5f;
  const glm::dvec3 lamp_at(4, 6, -3);
  const scene::RenderScene scene =
      SceneBuilder(0.f).ground(200).with({lamp(glm::vec3(lamp_at), flux, 0.01f)});
  const scene::CameraPose pose{{0, 9, 20}, {1, 0, -4}, {0, 1, 0}, 30};
  const auto rays = rays_of(pose, 4);
  for (const render::Estimator estimator :
       {render::Estimator::reference, render::Estimator::traced}) {
    render::RenderSettings settings = with_estimator(estimator);
    settings.air = air;
    const measure::Image image = render(scene, pose, settings, 4, 4, 512);
    double sum = 0, expected_sum = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      expected_sum += scattered_by_quadrature(
          rays[i], lamp_at, double(flux) / (4 * pi), 3.912 / (1000 * double(air.visibility_km)),
          air.height_m > 0 ? 1 / double(air.height_m) : 0, double(air.asymmetry),
          double(air.albedo), -rays[i].origin.y / rays[i].direction.y);
      sum += luminance(image, i);
    }
    EXPECT_NEAR(sum / expected_sum, 1, tolerance) << render::name_of(estimator);
  }
}

TEST(Air, OneLampInFogEqualsQuadrature) {
  expect_quadrature({.visibility_km = 0.05f, .asymmetry = 0}, 0.005);
}
TEST(Air, OneLampInFogThatScattersForwardsEqualsQuadrature) {
  expect_quadrature({.visibility_km = 0.1f, .asymmetry = 0.8f, .albedo = 0.9f}, 0.01);
}
TEST(Air, OneLampInALayerOfFogEqualsQuadrature) {
  expect_quadrature({.visibility_km = 0.03f, .height_m = 4, .asymmetry = -0.5f}, 0.01);
}

// Light is weakened by exp(-beta distance) on its way to the surface, and again to the eye.
TEST(Air, WeakensLightOnItsWayToASurfaceAndToTheEye) {
  const scene::RenderScene scene = SceneBuilder(0.4f).ground(100).with({lamp({0, 8, 0}, 5000)});
  const scene::CameraPose pose{{0, 30, 0}, {0, 0, 0}, {0, 0, -1}, 10};
  for (const render::Estimator estimator :
       {render::Estimator::reference, render::Estimator::traced}) {
    render::RenderSettings settings = in_air(estimator, 0.1f);
    settings.air.albedo = 0;  // it takes light and does not scatter it
    const measure::Image image = render(scene, pose, settings, 16, 16, 4);
    const auto& points = image.layer("position")->values;
    const auto& passed = image.layer("transmittance")->values;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      const glm::dvec3 at(points[3 * i], points[3 * i + 1], points[3 * i + 2]);
      const double to_lamp = glm::length(glm::dvec3(0, 8, 0) - at),
                   to_eye = glm::length(glm::dvec3(pose.position) - at), beta = 3.912 / 100;
      EXPECT_NEAR(double(passed[i]), std::exp(-beta * to_eye), 1e-5);
      const double expected = 0.4 / pi * 5000 / (4 * pi) * 8 / (to_lamp * to_lamp * to_lamp) *
                              std::exp(-beta * (to_lamp + to_eye));
      EXPECT_NEAR(luminance(image, i), expected, 0.01 * expected) << "pixel " << i;
    }
  }
}

// The layers of a picture in fog still sum to it.
TEST(Air, IsALayerOfItsOwnAndLayersSumToThePicture) {
  const scene::RenderScene scene = boxes_on_a_plane().with(
      {lamp({-6, 7, 0}, 6000, 0.3f), window({0, 3, -9.9f}, {0, 0, 1}, 0.6f, 0.9f, 400)});
  const scene::CameraPose pose{{-9, 10, 17}, {0, 1, 0}, {0, 1, 0}, 50};
  for (const render::Estimator estimator :
       {render::Estimator::reference, render::Estimator::traced}) {
    render::RenderSettings settings = in_air(estimator, 0.2f, 0.8f);
    settings.sampling.layers = true;
    settings.environment.sky_cd_m2 = glm::vec3(0.02f);
    settings.indirect.bounces = 1;
    const measure::Image image = render(scene, pose, settings, 16, 16, 2);
    double air = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      float sum = 0;
      for (const char* name : {"direct_lamps", "direct_windows", "direct_vehicles", "sky",
                               "emitted", "indirect", "air"})
        sum += image.layer(name)->values[3 * i];
      EXPECT_NEAR(sum, image.rgb[3 * i], 1e-4f * image.rgb[3 * i] + 1e-7f) << "pixel " << i;
      air += double(image.layer("air")->values[3 * i]);
    }
    EXPECT_GT(air, 0);
  }
}

// Koschmieder: at the visibility's distance, air in an even sky's light shows 98 % of that sky.
TEST(Air, HidesADarkThingAtTheDistanceOfItsVisibility) {
  const scene::RenderScene scene =
      SceneBuilder(0.f)
          .quad({-500, -500, -100}, {500, -500, -100}, {500, 500, -100}, {-500, 500, -100})
          .with({});
  render::RenderSettings settings = in_air(render::Estimator::traced, 0.1f);
  settings.environment.sky_cd_m2 = glm::vec3(2);
  const measure::Image image =
      render(scene, {{0, 0, 0}, {0, 0, -100}, {0, 1, 0}, 1}, settings, 2, 2, 1);
  EXPECT_NEAR(luminance(image, 0), 2 * 0.98, 0.001);
}

// Far from the origin air is as it is near it: it is followed from the eye.
TEST(Air, FarFromTheOriginGlowsAsNearIt) {
  const auto mean_at = [](float shift) {
    const glm::vec3 off(shift, 0, -shift);
    const scene::RenderScene scene =
        SceneBuilder(0.f)
            .quad(off + glm::vec3(-50, 0, -50), off + glm::vec3(-50, 0, 50),
                  off + glm::vec3(50, 0, 50), off + glm::vec3(50, 0, -50))
            .with({lamp(off + glm::vec3(4, 6, -3), 1e5f, 0.05f)});
    const scene::CameraPose pose{
        off + glm::vec3(0, 9, 20), off + glm::vec3(1, 0, -4), {0, 1, 0}, 30};
    return mean_luminance(
        render(scene, pose, in_air(render::Estimator::reference, 0.05f), 8, 8, 128));
  };
  EXPECT_NEAR(mean_at(100'000) / mean_at(0), 1, 0.005);
}

// Passes that have air compiled in without need show the same picture, up to rounding.
TEST(Air, CompiledInWithoutNeedChangesNothing) {
  const scene::RenderScene scene = boxes_on_a_plane().with(
      {lamp({-6, 7, 0}, 6000, 0.3f), window({0, 3, -9.9f}, {0, 0, 1}, 0.6f, 0.9f, 400)});
  const scene::CameraPose pose{{-9, 10, 17}, {0, 1, 0}, {0, 1, 0}, 50};
  render::RenderSettings settings = with_estimator(render::Estimator::ris);
  const measure::Image without = render(scene, pose, settings, 16, 16, 2);
  settings.forced_features = 1u << CONSTANT_AIR;
  const measure::Image with = render(scene, pose, settings, 16, 16, 2);
  for (std::size_t i = 0; i < without.rgb.size(); ++i)
    EXPECT_NEAR(with.rgb[i], without.rgb[i], 1e-4f * without.rgb[i]) << i;
}

TEST(Air, AVisibilityHasBounds) {
  render::RenderSettings settings;
  for (const float visibility_km : {-1.0f, 1e6f, std::nanf("")}) {
    settings.air.visibility_km = visibility_km;
    EXPECT_THROW(render::check_settings(settings), UsageError) << visibility_km;
  }
  settings.air.visibility_km = 1e-30f;  // black fog
  EXPECT_NO_THROW(render::check_settings(settings));
  EXPECT_NEAR(render::extinction_of(settings.air), 3.912f, 1e-4f);
  const scene::RenderScene scene = SceneBuilder(0.5f).ground(50).with({lamp({0, 6, 0}, 5000)});
  for (const render::Estimator estimator :
       {render::Estimator::reference, render::Estimator::traced}) {
    settings.sampling.estimator = estimator;
    settings.air.height_m = 1e-40f;  // counts as a layer of a millimetre
    const measure::Image image =
        render(scene, {{0, 30, 0}, {0, 0, 0}, {0, 0, -1}, 40}, settings, 8, 8, 2);
    for (const float value : image.rgb) EXPECT_TRUE(std::isfinite(value));
  }
}

}  // namespace
}  // namespace nightcity::test
