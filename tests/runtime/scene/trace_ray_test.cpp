#include "runtime/scene/trace_ray.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "runtime/scene/brute_force.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

void expect_hits_like_brute_force(const scene::RenderScene& scene) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> in(-1, 1);
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const glm::dvec3 origin(90 * in(random), 15 + 20 * in(random), 90 * in(random));
    glm::dvec3 direction(in(random), in(random), in(random));
    if (i % 5 == 0) direction = {0, -1, 0};  // along an axis
    if (i % 7 == 0) direction = {1, 0, 0};
    const std::uint32_t mask = i % 2 == 0 ? MASK_SHADOW : MASK_VISIBLE;
    const auto expected = scene::brute_force_hit(scene, origin, direction, 500, mask);
    const auto found = scene::trace_ray(scene, origin, direction, 500, mask);
    ASSERT_EQ(found.has_value(), expected.has_value()) << i;
    if (!found) continue;
    ++hits;
    EXPECT_NEAR(found->distance, *expected, 1e-9);
    EXPECT_NEAR(glm::length(found->normal), 1, 1e-9);
    EXPECT_LE(glm::dot(found->normal, direction), 0);
  }
  EXPECT_GT(hits, 1000);
}

TEST(TraceRay, MeetsWhatEveryTriangleTestedMeets) {
  expect_hits_like_brute_force(random_town(60, 80, 3).with(random_lamps(30, 60, 4)));
}

TEST(TraceRay, MeetsTheSameInATownAtAnAngle) {
  const scene::RenderScene scene = turned(random_town(60, 80, 3), 33).with(random_lamps(30, 60, 4));
  EXPECT_NE(scene.boxes_along, glm::vec2(1, 0));
  expect_hits_like_brute_force(scene);
}

// Crowns are instances, whose leaves lie among those of the houses.
TEST(TraceRay, MeetsTreesAmongHousesAndTheGroundAroundThem) {
  for (const float angle : {0.0f, 33.0f}) {
    const scene::RenderScene scene = town_with_surroundings(angle).with({});
    EXPECT_EQ(scene.boxes_along == glm::vec2(1, 0), angle == 0);
    EXPECT_NE(scene.horizon.root, BVH_EMPTY);
    expect_hits_like_brute_force(scene);
  }
}

// A margin for such coordinates would make every box as wide as the town.
TEST(TraceRay, TurnsNoBoxesWhereOneThingIsAstray) {
  SceneBuilder builder = turned(random_town(60, 80, 3), 33);
  builder.box({3e8f, 0, 0}, {3e8f + 1000, 900, 1000});
  const scene::RenderScene scene = builder.with({});
  EXPECT_EQ(scene.boxes_along, glm::vec2(1, 0));
  expect_hits_like_brute_force(scene);
}

TEST(TraceRay, TellsTheNormalOfAGroundAndOfAWall) {
  const scene::RenderScene scene = SceneBuilder().ground(50).box({5, 0, -5}, {6, 9, 5}).with({});
  const auto down = scene::trace_ray(scene, {0, 3, 0}, {0, -1, 0}, 100, MASK_VISIBLE);
  ASSERT_TRUE(down);
  EXPECT_EQ(down->normal, glm::dvec3(0, 1, 0));
  const auto wall = scene::trace_ray(scene, {0, 3, 0}, {2, 0, 0}, 100, MASK_VISIBLE);
  ASSERT_TRUE(wall);
  EXPECT_EQ(wall->normal, glm::dvec3(-1, 0, 0));
  EXPECT_NEAR(wall->distance, 2.5, 1e-9);  // in units of the direction
}

TEST(TraceRay, AnEmptySceneIsNeverHit) {
  EXPECT_FALSE(scene::trace_ray({}, {0, 0, 0}, {0, -1, 0}, 100, MASK_VISIBLE));
}

}  // namespace
}  // namespace nightcity::test
