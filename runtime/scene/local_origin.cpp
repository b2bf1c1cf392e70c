#include "runtime/scene/local_origin.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <vector>

#include "runtime/scene/mesh_placement.h"

namespace nightcity::scene {
namespace {

// Model coordinates that are multiples of it keep all their digits when it is taken off.
constexpr double step_m = 1024;
// The share of a scene that keeps its origin where it is.
constexpr double min_share = 0.01;

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

double largest(const glm::dvec3& v) {
  return std::max({v.x, v.y, v.z});
}

// The number of things, and of those that come near the origin.
struct Census {
  std::size_t all = 0, near = 0;
  void count(bool is_near) {
    ++all;
    near += is_near;
  }
  bool holds_origin() const { return near > 0 && double(near) >= min_share * double(all); }
};

}  // namespace

glm::dvec3 find_local_origin(const Scene& scene, const MeshSource& meshes,
                             std::span<const Light> lights) {
  Census placed, shining;
  std::vector<glm::dvec3> middles;
  for (const SceneNode& node : scene.nodes) {
    if (node.vehicle != no_id || is_horizon(node) || meshes.bounds.at(node.mesh).empty()) continue;
    for (const SceneInstance& instance : node.instances) {
      const auto [middle, half] = place_box(meshes.bounds[node.mesh], instance);
      if (!is_finite(middle) || !is_finite(half)) continue;
      placed.count(largest(glm::abs(middle) - half) <= max_reach_m);
      middles.push_back(middle);
    }
  }
  for (const Light& light : lights)
    if (const glm::dvec3 place(light.position); is_finite(place))
      shining.count(largest(glm::abs(place)) <= max_reach_m);
  if (middles.empty() || placed.holds_origin() || shining.holds_origin()) return glm::dvec3(0);
  glm::dvec3 origin(0);
  for (int axis = 0; axis < 3; ++axis) {
    const auto median = middles.begin() + static_cast<std::ptrdiff_t>((middles.size() - 1) / 2);
    std::nth_element(middles.begin(), median, middles.end(),
                     [&](const glm::dvec3& a, const glm::dvec3& b) { return a[axis] < b[axis]; });
    origin[axis] = std::round((*median)[axis] / step_m) * step_m;
  }
  return origin;
}

}  // namespace nightcity::scene
