#include "runtime/experiments/ray_set.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "support/scenes.h"

namespace nightcity::test {
namespace {

TEST(RaySet, HasARayOfTheCameraForEachPixel) {
  const auto rays = experiments::make_primary_rays(looking_down, 20, 12);
  ASSERT_EQ(rays.size(), 240u);
  glm::vec3 sum(0);
  for (const gpu::ProbeRay& ray : rays) {
    EXPECT_EQ(ray.from, looking_down.position);
    EXPECT_NEAR(glm::length(ray.way), 1, 1e-6);
    sum += ray.way;
  }
  const glm::vec3 middle = glm::normalize(sum);
  EXPECT_NEAR(middle.y, -1, 1e-5) << "pixels lie evenly about the view";
  // The first eight are the top row of the first square.
  EXPECT_NEAR(rays[0].way.z / rays[0].way.y, rays[7].way.z / rays[7].way.y, 1e-5);
}

TEST(RaySet, SendsShadowRaysFromSurfacesToLightsInFrontOfThem) {
  const std::vector<Light> lamps{lamp({3, 6, 2}, 1000), lamp({-4, 5, 0}, 3000),
                                 lamp({0, -9, 0}, 50'000)};
  const scene::RenderScene scene = SceneBuilder().ground(40).with(lamps);
  const auto primary = experiments::make_primary_rays(looking_down, 40, 40);
  const auto shadow = experiments::make_shadow_rays(scene, primary);
  // One lamp below the ground has most of the flux: all 24 draws meet it in 0.93^24 of the pixels.
  ASSERT_GT(shadow.size(), primary.size() / 2);
  ASSERT_LT(shadow.size(), primary.size());
  for (const gpu::ProbeRay& ray : shadow) {
    EXPECT_NEAR(ray.from.y, 0.01f, 1e-4);
    const glm::vec3 end = ray.from + ray.way;
    EXPECT_TRUE(glm::distance(end, lamps[0].position) < 1e-3f ||
                glm::distance(end, lamps[1].position) < 1e-3f);
    EXPECT_LT(ray.t_max, 1) << "the lamp's own surface is none that hides it";
  }
}

TEST(RaySet, HasNoShadowRaysWithoutLightOrSurfaces) {
  const auto primary = experiments::make_primary_rays(looking_down, 8, 8);
  EXPECT_TRUE(experiments::make_shadow_rays(SceneBuilder().ground(40).with({}), primary).empty());
  const auto up = experiments::make_primary_rays({{0, 3, 0}, {0, 30, 0}, {0, 0, 1}, 40}, 8, 8);
  EXPECT_TRUE(
      experiments::make_shadow_rays(SceneBuilder().ground(40).with({lamp({0, 9, 0}, 100)}), up)
          .empty());
}

}  // namespace
}  // namespace nightcity::test
