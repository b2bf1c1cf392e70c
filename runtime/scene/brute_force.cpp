#include "runtime/scene/brute_force.h"

#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace nightcity::scene {

std::optional<double> brute_force_hit(const RenderScene& scene, const glm::dvec3& origin,
                                      const glm::dvec3& direction, double t_max,
                                      std::uint32_t mask) {
  double nearest = t_max;
  bool found = false;
  const auto test = [&](const gpu::Triangle& triangle, const glm::dvec3& o, const glm::dvec3& d) {
    const glm::dvec3 v0(triangle.v0), e1 = glm::dvec3(triangle.v1) - v0,
                                      e2 = glm::dvec3(triangle.v2) - v0;
    const glm::dvec3 p = glm::cross(d, e2);
    const double determinant = glm::dot(e1, p);
    if (determinant == 0) return;
    const glm::dvec3 s = o - v0;
    const double u = glm::dot(s, p) / determinant;
    const glm::dvec3 q = glm::cross(s, e1);
    const double v = glm::dot(d, q) / determinant;
    const double t = glm::dot(e2, q) / determinant;
    if (u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < nearest) {
      nearest = t;
      found = true;
    }
  };
  for (const gpu::Instance& instance : scene.instances) {
    if (!(instance.mask & mask)) continue;
    const auto row = [&](int i, const glm::dvec3& v, double w) {
      return glm::dot(glm::dvec4(instance.to_object[i]), glm::dvec4(v, w));
    };
    const glm::dvec3 o(row(0, origin, 1), row(1, origin, 1), row(2, origin, 1));
    const glm::dvec3 d(row(0, direction, 0), row(1, direction, 0), row(2, direction, 0));
    // Every triangle below the instance's root, without a look at the boxes.
    std::vector<std::uint32_t> pending{instance.root};
    while (!pending.empty()) {
      const std::uint32_t node = pending.back();
      pending.pop_back();
      if (node == BVH_EMPTY) continue;
      if (node & BVH_LEAF) {
        if (node & BVH_INSTANCE) continue;  // it has its own turn
        const std::uint32_t first = node & BVH_LEAF_FIRST_MASK;
        const std::uint32_t count = ((node & ~BVH_LEAF) >> BVH_LEAF_COUNT_SHIFT) + 1;
        for (std::uint32_t i = first; i < first + count; ++i)
          test(scene.triangles[scene.triangle_order[i]], o, d);
      } else {
        for (const std::uint32_t child : scene.nodes[node].child) pending.push_back(child);
      }
    }
  }
  if (!found) return std::nullopt;
  return nearest;
}

}  // namespace nightcity::scene
