#include "runtime/scene/wall_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <span>

#include "formats/hierarchy/wall_directions.h"

namespace nightcity::scene {

glm::vec2 find_wall_direction(const TriangleList& triangles, std::size_t first, std::size_t end) {
  constexpr std::size_t enough = 1 << 16, at_once = 64;
  const std::size_t step = std::max(at_once, (end - first) / enough * at_once);
  hierarchy::WallDirections directions;
  std::array<hierarchy::Corners, at_once> corners;
  for (std::size_t i = first; i < end; i += step) {
    const auto some = std::span(corners).first(std::min(at_once, end - i));
    triangles.copy_corners(i, some);
    for (const hierarchy::Corners& triangle : some) directions.add(triangle);
  }
  return directions.find_frame().along;
}

double find_reach(const Scene& scene, const MeshSource& meshes, const MeshPlacement& placement,
                  const glm::dvec3& origin) {
  double reach = 0;
  for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
    const SceneNode& node = scene.nodes[i];
    if (placement.is_skipped(i) || is_horizon(node) || meshes.bounds.at(node.mesh).empty())
      continue;
    const glm::dvec3 lower(meshes.bounds[node.mesh].lower), upper(meshes.bounds[node.mesh].upper);
    for (const SceneInstance& instance : node.instances) {
      const glm::dmat4 to_model = to_double(instance);
      const glm::dvec3 middle(to_model * glm::dvec4((lower + upper) / 2.0, 1));
      for (int axis = 0; axis < 3; ++axis) {
        double half = 0;
        for (int of_mesh = 0; of_mesh < 3; ++of_mesh)
          half += std::abs(to_model[of_mesh][axis]) * (upper[of_mesh] - lower[of_mesh]) / 2;
        const double far = std::abs(middle[axis] - origin[axis]) + half;
        if (std::isfinite(far)) reach = std::max(reach, far);
      }
    }
  }
  return reach;
}

}  // namespace nightcity::scene
