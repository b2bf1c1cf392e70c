#include "runtime/scene/mesh_placement.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>

#include "runtime/scene/trace_ray.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

constexpr std::size_t posts = 6;

// Posts of twelve triangles, each with a light of its own, on a ground of 2 n^2 triangles.
SceneBuilder posts_on_ground(int n) {
  SceneBuilder builder, post;
  const float side = 40.0f / float(n);
  for (int x = 0; x < n; ++x)
    for (int z = 0; z < n; ++z) {
      const float x0 = float(x) * side - 20, z0 = float(z) * side - 20;
      builder.quad({x0, 0, z0}, {x0, 0, z0 + side}, {x0 + side, 0, z0 + side}, {x0 + side, 0, z0});
    }
  post.box({-1, 0, -1}, {1, 4, 1});
  builder.scene().meshes.push_back(post.scene().meshes[0]);
  SceneNode node{"posts", "lamp", 1, true, {}};
  for (std::size_t i = 0; i < posts; ++i) {
    SceneInstance& instance = node.instances.emplace_back();
    const float turn = float(i);
    instance.to_model[0] = {std::cos(turn), 0, -std::sin(turn), 0};
    instance.to_model[2] = {std::sin(turn), 0, std::cos(turn), 0};
    instance.to_model[3] = {float(i) * 6 - 15, 0, 3, 1};
    instance.light = static_cast<std::uint32_t>(i);
  }
  builder.scene().nodes.push_back(node);
  return builder;
}

std::vector<Light> lights_of_posts() {
  return std::vector<Light>(posts, lamp({0, 30, 0}, 1000));
}

std::uint32_t light_seen(const scene::RenderScene& scene, const scene::RayHit& hit) {
  const std::uint32_t light = scene.instances[hit.instance].light;
  return light != NO_HIT ? light : scene.triangles[hit.triangle].light;
}

TEST(MeshPlacement, CopiesOfASmallMeshAreSeenAsItsInstancesAre) {
  const scene::RenderScene instanced = posts_on_ground(1).with(lights_of_posts()),
                           copied = posts_on_ground(9).with(lights_of_posts());
  ASSERT_EQ(instanced.instances.size(), 1 + posts);
  ASSERT_EQ(copied.instances.size(), 1u);
  ASSERT_EQ(copied.triangles.size(), 2 * 81 + 12 * posts);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> along(-1, 1);
  std::size_t lit = 0;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 from(20 * along(random), 9, 20 * along(random)),
        way = glm::normalize(glm::dvec3(along(random), -0.4, along(random)));
    const auto a = scene::trace_ray(instanced, from, way, 1e3, MASK_SHADOW),
               b = scene::trace_ray(copied, from, way, 1e3, MASK_SHADOW);
    ASSERT_EQ(a.has_value(), b.has_value());
    if (!a) continue;
    EXPECT_NEAR(a->distance, b->distance, 1e-5);
    EXPECT_GT(glm::dot(a->normal, b->normal), 1 - 1e-9);
    EXPECT_EQ(light_seen(instanced, *a), light_seen(copied, *b));
    lit += light_seen(copied, *b) != NO_HIT;
  }
  EXPECT_GT(lit, 100u);
}

TEST(MeshPlacement, InstancesAndCopiesAreTheObjectsThatTheyName) {
  for (const int n : {1, 9}) {  // instanced, and copied
    SceneBuilder builder = posts_on_ground(n);
    for (std::size_t i = 0; i < posts; ++i)
      builder.scene().nodes[1].instances[i].feature = static_cast<std::uint32_t>(10 + i);
    const scene::RenderScene scene = builder.with(lights_of_posts());
    for (std::size_t i = 0; i < posts; ++i) {
      const auto hit =
          scene::trace_ray(scene, {double(i) * 6 - 15, 9, 3}, {0, -1, 0}, 8, MASK_SHADOW);
      ASSERT_TRUE(hit);
      const std::uint32_t own = scene.instances[hit->instance].feature;
      EXPECT_EQ(own != NO_HIT ? own : scene.triangles[hit->triangle].feature, 10 + i);
    }
  }
}

TEST(MeshPlacement, CopiesAreAtMostHalfOfWhatStandsOnce) {
  // 12 triangles of 6 posts need 144 that stand once: 2 n^2 >= 144.
  EXPECT_EQ(posts_on_ground(8).with(lights_of_posts()).instances.size(), 1 + posts);
  EXPECT_EQ(posts_on_ground(9).with(lights_of_posts()).instances.size(), 1u);
}

TEST(MeshPlacement, LargeMeshesStayInstanced) {
  SceneBuilder builder = posts_on_ground(40), post;
  for (int i = 0; i < 6; ++i) post.box({-1, i, -1}, {1, i + 1, 1});
  builder.scene().meshes[1] = post.scene().meshes[0];
  EXPECT_EQ(builder.with(lights_of_posts()).instances.size(), 1 + posts) << "72 triangles each";
}

TEST(MeshPlacement, CopiesWithoutVolumeAreCountedOnceEach) {
  SceneBuilder builder = posts_on_ground(9);
  builder.scene().nodes[1].instances[2].to_model[1] = {0, 0, 0, 0};
  const scene::RenderScene scene = builder.with(lights_of_posts());
  EXPECT_EQ(scene.dropped_instances, 1u);
  EXPECT_EQ(scene.dropped_triangles, 0u);
  EXPECT_EQ(scene.triangles.size(), 2 * 81 + 12 * (posts - 1));
}

// A ray divides coordinates by components of its direction, down to 1e-15 of the largest.
TEST(MeshPlacement, WhatLiesBeyondReachIsCountedAndLeftOut) {
  SceneBuilder builder = posts_on_ground(40);  // its posts are copied, so their triangles count
  builder.quad({0, 0, 0}, {1e20f, 0, 0}, {1e20f, 1, 0}, {0, 1, 0});
  builder.scene().nodes[1].instances[2].to_model[3] = {1e17f, 0, 0, 1};
  const scene::RenderScene copied = builder.with(lights_of_posts());
  EXPECT_EQ(copied.dropped_triangles, 2u + 12u);
  EXPECT_EQ(copied.dropped_instances, 0u);

  SceneBuilder post;
  for (int i = 0; i < 6; ++i) post.box({-1, i, -1}, {1, i + 1, 1});
  builder.scene().meshes[1] = post.scene().meshes[0];
  const scene::RenderScene instanced = builder.with(lights_of_posts());
  EXPECT_EQ(instanced.dropped_triangles, 2u);
  EXPECT_EQ(instanced.dropped_instances, 1u);
  EXPECT_LT(instanced.bounds.upper.x, 100);
}

}  // namespace
}  // namespace nightcity::test
