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

// Adds a piece of carriageway, 5 mm above the ground.
void add_asphalt(SceneBuilder& builder, const std::vector<glm::dvec2>& quad) {
  Scene& scene = builder.scene();
  if (scene.materials.size() == 1) {
    scene.materials.push_back({"asphalt", glm::vec3(0.1f), glm::vec3(0), 1.0f, true});
    scene.meshes[0].primitives.push_back({});
    scene.meshes[0].primitives[1].material = 1;
  }
  ScenePrimitive& p = scene.meshes[0].primitives[1];
  const auto base = static_cast<std::uint32_t>(p.positions.size());
  for (const glm::dvec2& at : quad) p.positions.emplace_back(at.x, 0.005, at.y);
  for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u}) p.indices.push_back(base + i);
}

// A street along x that houses end on both sides, 90 m apart, and behind its houses a yard that
// leaves a far longer view between two walls.
SceneBuilder street_beside_a_yard() {
  SceneBuilder builder;
  builder.ground(200)
      .box({-200, 0, -27}, {200, 12, -7})
      .box({-200, 0, 7}, {200, 12, 27})
      .box({-65, 0, -7}, {-45, 12, 7})
      .box({45, 0, -7}, {65, 12, 7})
      .box({-200, 0, 41}, {200, 12, 60});
  return builder;
}

TEST(StreetView, StandsOnTheStreetBesideAYardWithALongerView) {
  {
    const scene::RenderScene plain = street_beside_a_yard().with({});
    const auto pose = scene::find_street_view(plain);
    ASSERT_TRUE(pose);
    ASSERT_GT(std::abs(pose->position.z), 7.0f) << "the yard is to be the better view";
  }
  SceneBuilder with_asphalt = street_beside_a_yard();
  add_asphalt(with_asphalt, {{-45, -4}, {-45, 4}, {45, 4}, {45, -4}});
  for (const bool is_paved : {true, false})
    for (const bool is_named : {true, false}) {
      if (!is_paved && !is_named) continue;
      SceneBuilder builder = is_paved ? with_asphalt : street_beside_a_yard();
      if (is_named) builder.scene().places.streets.push_back({"Street", {{{-45, 0}, {45, 0}}}});
      const scene::RenderScene scene = builder.with({});
      const auto pose = scene::find_street_view(scene);
      ASSERT_TRUE(pose);
      expect_pedestrian(scene, *pose);
      EXPECT_LT(std::abs(pose->position.z), 4.0f) << is_paved << is_named;
      EXPECT_LT(std::abs(pose->position.x), 45.0f);
      const glm::vec3 ahead = glm::normalize(pose->target - pose->position);
      EXPECT_GT(std::abs(ahead.x), 0.97f) << is_paved << is_named;
    }
}

// A quarter of a circle about the origin, between no houses at all.
TEST(StreetView, LooksAlongACurvedStreet) {
  constexpr double radius = 60;
  SceneBuilder builder;
  builder.ground(150);
  std::vector<glm::dvec2> line;
  const auto at = [](int i, double r) {
    const double angle = 3.14159265 / 2 * i / 18;
    return r * glm::dvec2(std::cos(angle), std::sin(angle));
  };
  for (int i = 0; i <= 18; ++i) {
    line.push_back(at(i, radius));
    if (i == 18) break;
    add_asphalt(builder, {at(i, radius - 4), at(i, radius + 4), at(i + 1, radius + 4),
                          at(i + 1, radius - 4)});
  }
  builder.scene().places.streets.push_back({"Bow", {line}});
  const scene::RenderScene scene = builder.with({});
  const auto pose = scene::find_street_view(scene);
  ASSERT_TRUE(pose);
  expect_pedestrian(scene, *pose);
  const glm::vec3 eye(pose->position.x, 0, pose->position.z);
  EXPECT_NEAR(glm::length(eye), radius, 8.0);
  glm::vec3 ahead = pose->target - pose->position;
  ahead.y = 0;
  EXPECT_LT(std::abs(glm::dot(glm::normalize(ahead), glm::normalize(eye))), 0.3f);
}

// Vehicles along x tell of a street that has no name and no surface of its own.
TEST(StreetView, FindsAStreetByItsVehicles) {
  scene::RenderScene scene = street_beside_a_yard().with({});
  for (int i = -4; i <= 4; ++i) {
    TripKnot knot{};
    knot.position = {10.0f * float(i), 0, 0};
    knot.velocity = {10, 0, 0};
    scene.traffic.knots.push_back(knot);
  }
  const auto pose = scene::find_street_view(scene);
  ASSERT_TRUE(pose);
  expect_pedestrian(scene, *pose);
  EXPECT_NEAR(std::abs(pose->position.z), 1.75f, 0.01f);
  EXPECT_GT(std::abs(glm::normalize(pose->target - pose->position).x), 0.97f);
}

TEST(StreetView, WithoutGroundUnderTheSkyThereIsNone) {
  EXPECT_FALSE(scene::find_street_view(scene::RenderScene{}));
}

}  // namespace
}  // namespace nightcity::test
