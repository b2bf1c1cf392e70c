// Rays that are traced for their time meet what brute force in double meets.
#include "runtime/render/ray_probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

#include "runtime/scene/brute_force.h"
#include "support/gpu.h"
#include "support/scenes.h"

namespace nightcity::test {
namespace {

std::vector<gpu::ProbeRay> random_rays(std::size_t count, float t_max) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> in(-1, 1);
  std::vector<gpu::ProbeRay> rays(count);
  for (gpu::ProbeRay& ray : rays) {
    ray.from = {70 * in(random), 10 + 9 * in(random), 70 * in(random)};
    ray.way = {in(random), in(random), in(random)};
    ray.t_max = t_max;
  }
  return rays;
}

TEST(RayProbe, MeetsWhatBruteForceMeets) {
  const scene::RenderScene scene = turned(random_town(60, 60, 7), 20).with({});
  render::DeviceScene device_scene(test_device(), scene);
  for (const bool any_hit : {false, true}) {
    const auto rays = random_rays(3000, 40);
    const render::TracedRays traced =
        render::trace_rays(test_device(), test_passes(), device_scene, rays, any_hit, 3);
    ASSERT_EQ(traced.distances.size(), rays.size());
    ASSERT_EQ(traced.ms.size(), 3u);
    EXPECT_GT(*std::min_element(traced.ms.begin(), traced.ms.end()), 0);
    int hits = 0, wrong = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const auto truth =
          scene::brute_force_hit(scene, glm::dvec3(rays[i].from), glm::dvec3(rays[i].way), 40,
                                 any_hit ? MASK_SHADOW : MASK_VISIBLE);
      const double found = double(traced.distances[i]);
      hits += truth.has_value();
      if (truth.has_value() != (found >= 0) ||
          (truth && !any_hit && std::abs(found - *truth) > 1e-4 * *truth + 1e-5))
        ++wrong;
    }
    EXPECT_GT(hits, 1000);
    EXPECT_LE(wrong, 3) << "rays that graze an edge may differ between float and double";
  }
  EXPECT_TRUE(test_device().validation_messages().empty());
}

}  // namespace
}  // namespace nightcity::test
