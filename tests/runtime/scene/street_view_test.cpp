#include "runtime/scene/street_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/trace_ray.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

// A street of two rows of houses, 14 m wide and 200 m long, along x; behind it are yards.
SceneBuilder street_along_x() {
  SceneBuilder builder;
  builder.ground(150);
  for (int i = -5; i < 5; ++i) {
    const float x = 20.0f * float(i);
    builder.box({x, 0, -19}, {x + 18, 12, -7});
    builder.box({x, 0, 7}, {x + 18, 12, 19});
  }
  return builder;
}

void expect_pedestrian(const scene::RenderScene& scene, const scene::CameraPose& pose) {
  const glm::dvec3 eye(pose.position);
  const auto below = scene::trace_ray(scene, eye, {0, -1, 0}, 100, MASK_SHADOW);
  ASSERT_TRUE(below);
  EXPECT_NEAR(below->distance, 1.7, 0.01);
  EXPECT_NEAR(pose.position.y, 1.7, 0.01);  // on the ground, not on a roof
  EXPECT_FALSE(scene::trace_ray(scene, eye, {0, 1, 0}, 100, MASK_SHADOW));  // out of doors
  for (int i = 0; i < 64; ++i) {
    const double a = 2 * 3.14159265 * i / 64;
    const auto wall =
        scene::trace_ray(scene, eye, {std::cos(a), 0, std::sin(a)}, 1e4, MASK_VISIBLE);
    EXPECT_GT(wall ? wall->distance : 1e4, 1.4);
  }
}

TEST(StreetView, LooksAlongTheStreetWithLamps) {
  std::vector<Light> lamps;
  for (int i = -4; i <= 4; ++i) {
    lamps.push_back(lamp({20.0f * float(i), 6, -5}, 5000));
    lamps.back().tangent = {0, 0, 1};
  }
  const scene::RenderScene scene = street_along_x().with(lamps);
  const auto pose = scene::find_street_view(scene);
  ASSERT_TRUE(pose);
  expect_pedestrian(scene, *pose);
  EXPECT_LT(std::abs(pose->position.z), 5.0f);
  const glm::vec3 ahead = glm::normalize(pose->target - pose->position);
  EXPECT_GT(std::abs(ahead.x), 0.97f);
}

// Windows alone: their tangents lie along the walls.
TEST(StreetView, LooksAlongTheStreetWithoutLamps) {
  std::vector<Light> windows;
  for (int i = -5; i < 5; ++i) {
    windows.push_back(window({20.0f * float(i) + 9, 5, -6.99f}, {0, 0, 1}, 0.6f, 0.8f, 300));
    windows.push_back(window({20.0f * float(i) + 9, 5, 6.99f}, {0, 0, -1}, 0.6f, 0.8f, 300));
  }
  for (const auto& lights : {windows, std::vector<Light>{}}) {
    const scene::RenderScene scene = street_along_x().with(lights);
    const auto pose = scene::find_street_view(scene);
    ASSERT_TRUE(pose);
    expect_pedestrian(scene, *pose);
    EXPECT_LT(std::abs(pose->position.z), 5.0f);
    const glm::vec3 ahead = glm::normalize(pose->target - pose->position);
    EXPECT_GT(std::abs(ahead.x), 0.97f);
  }
}

TEST(StreetView, ALampInAWallOrOnARoofLeadsNobodyThere) {
  const scene::RenderScene scene = street_along_x().with(
      {lamp({9, 11, -7.5f}, 5000), lamp({9, 20, 12}, 5000), lamp({29, 13, 12}, 5000)});
  const auto pose = scene::find_street_view(scene);
  ASSERT_TRUE(pose);
  expect_pedestrian(scene, *pose);
}

TEST(StreetView, WithoutGroundUnderTheSkyThereIsNone) {
  EXPECT_FALSE(scene::find_street_view(scene::RenderScene{}));
}

}  // namespace
}  // namespace nightcity::test
