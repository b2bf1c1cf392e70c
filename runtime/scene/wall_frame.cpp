#include "runtime/scene/wall_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
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
    for (const SceneInstance& instance : node.instances) {
      const auto [middle, half] = place_box(meshes.bounds[node.mesh], instance);
      const glm::dvec3 farthest = glm::abs(middle - origin) + half;
      for (int axis = 0; axis < 3; ++axis)
        if (std::isfinite(farthest[axis])) reach = std::max(reach, farthest[axis]);
    }
  }
  return reach;
}

}  // namespace nightcity::scene
