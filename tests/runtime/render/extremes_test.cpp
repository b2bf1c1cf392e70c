// Scenes at the extremes of their numbers, against closed forms. docs/extremes.md has the bounds.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "support/estimators.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

using std::numbers::pi;

const scene::CameraPose from_above{{0.1f, 20, 0.2f}, {0.1f, 0, 0.2f}, {0, 0, -1}, 60};

// Returns what a plane of reflectance 1/2 through `foot`, with unit `normal`, shows under a point
// lamp where a pixel's ray meets it, cd/m2. All in double, from the pose alone.
double expected(const scene::CameraPose& pose, int side, std::size_t pixel, const glm::dvec3& foot,
                const glm::dvec3& normal, const glm::dvec3& lamp, double flux) {
  const glm::dvec3 eye(pose.position),
      forward = glm::normalize(glm::dvec3(pose.target) - eye),
      right = glm::normalize(glm::cross(forward, glm::dvec3(pose.up))),
      up = glm::cross(right, forward);
  const double tangent = std::tan(double(pose.fov_deg) * pi / 360),
               x = (2 * (double(pixel % std::size_t(side)) + 0.5) / side - 1) * tangent,
               y = (1 - 2 * (double(pixel / std::size_t(side)) + 0.5) / side) * tangent;
  const glm::dvec3 direction = forward + x * right + y * up;
  const glm::dvec3 point =
      eye + direction * (glm::dot(foot - eye, normal) / glm::dot(direction, normal));
  const glm::dvec3 way = lamp - point;
  const double d2 = glm::dot(way, way);
  return 0.5 / pi * flux / (4 * pi) * std::max(0.0, glm::dot(way, normal)) / (d2 * std::sqrt(d2));
}

render::RenderSettings exact(render::Estimator estimator = render::Estimator::reference) {
  render::RenderSettings settings = with_estimator(estimator);
  settings.sampling.jitter = false;
  return settings;
}

// Walls, kerb and lamp at 10,000 km look as they do at the origin: the same shadows, and light
// within a thousandth (rounding to float puts vertices up to 30 um elsewhere).
TEST(FarOrigin, APictureAtTenThousandKilometresIsThatAtTheOrigin) {
  const auto at = [](const glm::dvec3& place) {
    SceneBuilder builder;
    builder.ground(50).box({-5, 0, 3}, {5, 4, 3.01f}).box({-5, 0, -3}, {5, 0.12f, -2.7f});
    SceneInstance& instance = builder.scene().nodes[0].instances[0];
    instance.to_model[3] = glm::vec4(glm::vec3(place), 1);
    instance.translation_rest = glm::vec3(place - glm::dvec3(glm::vec3(place)));
    const scene::RenderScene scene =
        builder.with({lamp(glm::vec3(place) + glm::vec3(1, 8, 0), 5000, 0)});
    scene::CameraPose pose{{0, 20, 0.5f}, {0, 0, 0.5f}, {0, 0, -1}, 50};
    pose.origin = place;
    return render(scene, pose, exact(), 48, 48, 1);
  };
  const measure::Image near = at(glm::dvec3(0));
  for (const glm::dvec3& place : {glm::dvec3(1e7, 0, -1e7), glm::dvec3(412'000, 55, -5'762'000)}) {
    const measure::Image far = at(place);
    std::size_t other_shadow = 0, dark = 0;
    for (std::size_t i = 0; i < near.pixels(); ++i) {
      const double here = luminance(near, i), there = luminance(far, i);
      dark += here == 0;
      if ((here == 0) != (there == 0))
        ++other_shadow;
      else
        EXPECT_NEAR(there, here, 1e-3 * here) << "pixel " << i;
    }
    EXPECT_GT(dark, 50u);
    EXPECT_LE(other_shadow, 2u) << "pixels at the edge of a shadow";
    // The layer is in model space, in floats.
    const auto& points = far.layer("position")->values;
    EXPECT_NEAR(double(points[0]), place.x, 20.0);
    EXPECT_NEAR(double(points[2]), place.z, 20.0);
  }
}

// Light that falls in at 89.9 and 89.99 degrees on a plane whose normal is no axis. The cosine is
// right to 2e-7: 0.012 % and 0.12 % of it.
TEST(GrazingLight, OnATiltedPlaneFollowsTheCosine) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(-0.56, 0.74, 0.36)),
                   along = glm::normalize(glm::cross(normal, glm::dvec3(0, 0, 1))),
                   across = glm::cross(normal, along);
  const auto corner = [&](double a, double b) {
    return glm::vec3(200.0 * (a * along + b * across));
  };
  for (const double degrees : {80.0, 89.0, 89.9, 89.99}) {
    const double rise = (90 - degrees) * pi / 180, flux = 1e7;
    const glm::vec3 place(100.0 * (std::cos(rise) * along + std::sin(rise) * normal));
    const scene::RenderScene scene =
        SceneBuilder()
            .quad(corner(-1, -1), corner(-1, 1), corner(1, 1), corner(1, -1))
            .with({lamp(place, float(flux), 0)});
    const scene::CameraPose pose{glm::vec3(normal), glm::vec3(0), glm::vec3(along), 40};
    for (const render::Estimator estimator :
         {render::Estimator::reference, render::Estimator::traced}) {
      const measure::Image image = render(scene, pose, exact(estimator), 16, 16, 2);
      const double bound = 1e-5 + 4e-7 / std::cos(degrees * pi / 180);
      for (std::size_t i = 0; i < image.pixels(); ++i) {
        const double truth = expected(pose, 16, i, glm::dvec3(0), normal, glm::dvec3(place), flux);
        EXPECT_NEAR(luminance(image, i), truth, bound * truth)
            << degrees << " degrees, pixel " << i;
      }
    }
  }
}

// One square of ground that is 100 m to 10,000 km wide: a hit is found on the ray and on the plane.
TEST(VastGround, IsLitAsASmallOne) {
  for (const float half : {50.0f, 5e4f, 5e5f, 5e6f}) {
    const scene::RenderScene scene =
        SceneBuilder().ground(half).with({lamp({0.3f, 8, 0.7f}, 5000, 0)});
    const measure::Image image = render(scene, from_above, exact(), 24, 24, 1);
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      const double truth =
          expected(from_above, 24, i, {}, {0, 1, 0}, {double(0.3f), 8, double(0.7f)}, 5000);
      ASSERT_NEAR(luminance(image, i), truth, 1e-4 * truth) << half << " m, pixel " << i;
    }
  }
}

// The same, tilted: its corners are known to a float, so the plane is within 1e-7 of its size.
TEST(VastGround, TiltedIsOffByItsCornersAtMost) {
  const glm::dvec3 along = glm::normalize(glm::dvec3(0.8, 0.6, 0)),
                   normal = glm::normalize(glm::dvec3(-0.6, 0.8, 0));
  for (const double half : {5e3, 1e5}) {
    const auto corner = [&](double a, double b) {
      return glm::vec3(half * (a * along + b * glm::dvec3(0, 0, 1)));
    };
    const glm::vec3 place(8.0 * normal);
    const scene::RenderScene scene =
        SceneBuilder()
            .quad(corner(-1, -1), corner(-1, 1), corner(1, 1), corner(1, -1))
            .with({lamp(place, 5000, 0)});
    const scene::CameraPose pose{glm::vec3(20.0 * normal), glm::vec3(0), {0, 0, -1}, 60};
    const measure::Image image = render(scene, pose, exact(), 16, 16, 1);
    const double height_error = 2e-7 * half;  // of 8 m
    for (std::size_t i = 0; i < image.pixels(); ++i) {
      const double truth = expected(pose, 16, i, {}, normal, glm::dvec3(place), 5000);
      ASSERT_NEAR(luminance(image, i), truth, (1e-4 + 3 * height_error / 8) * truth)
          << half << " m, pixel " << i;
    }
  }
}

// A point lamp has no size: in the plane of the ground it lights none of it, and a metre above it
// lights it in every frame alike.
TEST(PointLamp, IsAPoint) {
  const measure::Image in_plane = render(SceneBuilder().ground(50).with({lamp({0, 0, 0}, 5000, 0)}),
                                         from_above, exact(), 24, 24, 4);
  EXPECT_EQ(mean_luminance(in_plane), 0.0);
  const measure::Image above =
      render(SceneBuilder().ground(50).with({lamp({0, 0.01f, 0}, 5000, 0)}), from_above, exact(),
             24, 24, 2);
  for (std::size_t i = 0; i < above.pixels(); ++i) {
    const double truth = expected(from_above, 24, i, {}, {0, 1, 0}, {0, double(0.01f), 0}, 5000);
    EXPECT_NEAR(luminance(above, i), truth, 1e-3 * truth) << "pixel " << i;
  }
}

// Lamps behind a wall that would give up to a million times the light of those before it: every
// pixel finds the visible ones in every frame, so that 48 frames are within a quarter of the truth
// in 49 of 50 pixels, and their mean within 5 %; with 32 candidates and four partners 32 frames
// are.
TEST(HiddenLamps, ThatOutshineTheRestDoNotDarkenThePicture) {
  std::vector<Light> visible;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> side(-8, 8), height(4, 9);
  for (int i = 0; i < 40; ++i)
    visible.push_back(lamp({side(random), height(random), side(random)}, 100));
  const auto scene_of = [&](const std::vector<Light>& lights) {
    return SceneBuilder().ground(50).box({-40, 0, 20}, {40, 30, 20.5f}).with(lights);
  };
  const measure::Image truth = render(scene_of(visible), from_above, exact(), 16, 16, 16);
  const auto expect_truth = [&](const measure::Image& image, const std::string& name) {
    EXPECT_NEAR(mean_luminance(image) / mean_luminance(truth), 1, 0.05) << name;
    std::size_t far_off = 0;
    for (std::size_t i = 0; i < image.pixels(); ++i)
      far_off += std::abs(luminance(image, i) / luminance(truth, i) - 1) > 0.25;
    EXPECT_LE(far_off, image.pixels() / 50) << name;
  };
  for (const std::size_t hidden : {1u, 4u})
    for (const float ratio : {10.0f, 1e3f, 1e6f}) {
      std::vector<Light> lights = visible;
      // At 24 m for 6 m, and slanting: some 40 times the flux for the same light.
      for (std::size_t i = 0; i < hidden; ++i)
        lights.push_back(lamp({float(i) - 1, 5, 24}, 40 * 4000 * ratio / float(hidden)));
      render::RenderSettings settings = exact(render::Estimator::traced);
      const scene::RenderScene scene = scene_of(lights);
      const std::string name = std::to_string(hidden) + ", " + std::to_string(ratio);
      expect_truth(render(scene, from_above, settings, 16, 16, 48), name);
      settings.sampling.candidates = 32;
      settings.reuse.neighbours = 4;
      expect_truth(render(scene, from_above, settings, 16, 16, 32), name + ", four partners");
    }
}

}  // namespace
}  // namespace nightcity::test
