#include "formats/hierarchy/static_geometry.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace nightcity::hierarchy {
namespace {

// A ray that meets an instance changes its frame, which costs more than the few triangles of a lamp
// post. So the triangles of small meshes are stored for each of their instances, up to this many.
constexpr std::size_t most_copied_triangles = 1'000'000, most_triangles_of_a_copy = 64;

}  // namespace

std::vector<double> find_units(const std::vector<SceneNode>& nodes, std::size_t meshes) {
  constexpr double usual = 1024;
  std::vector<double> units(meshes, 0.0);
  for (const SceneNode& node : nodes)
    for (const SceneInstance& instance : node.instances)
      for (int axis = 0; axis < 3; ++axis)
        units.at(node.mesh) = std::max(
            units.at(node.mesh), glm::length(glm::dvec3(glm::dmat4(instance.to_model)[axis])));
  for (double& unit : units) {
    const bool is_usual = unit >= 1 / usual && unit <= usual;
    const bool is_scale = unit > 0 && std::isfinite(unit);
    unit = is_usual || !is_scale ? 1 : std::exp2(std::round(std::log2(unit)));
  }
  return units;
}

std::vector<bool> find_static_nodes(const std::vector<SceneNode>& nodes,
                                    std::span<const std::size_t> triangles,
                                    const std::vector<bool>& skipped) {
  std::vector<bool> result;
  std::size_t placed_once = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const SceneNode& node = nodes[i];
    result.push_back(node.instances.size() == 1 && node.instances[0].light == no_id &&
                     node.instances[0].feature == no_id && !is_horizon(node));
    if (result[i] && !skipped[i]) placed_once += triangles[node.mesh];
  }
  // In a small scene copies would be most of the triangles.
  std::size_t room = std::min(most_copied_triangles, placed_once / 2);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const SceneNode& node = nodes[i];
    const std::size_t one = triangles[node.mesh], all = one * node.instances.size();
    const bool is_small = one > 0 && one <= most_triangles_of_a_copy && all <= room;
    if (result[i] || skipped[i] || !is_small || is_horizon(node)) continue;
    result[i] = true;
    room -= all;
  }
  return result;
}

bool keeps_volume(const glm::dmat4& to_scene, double unit) {
  const glm::dmat4 from_unit = glm::scale(glm::dmat4(1), glm::dvec3(1 / unit));
  const double determinant = glm::determinant(glm::dmat3(to_scene * from_unit));
  return std::isfinite(determinant) && std::abs(determinant) >= 1e-18;
}

}  // namespace nightcity::hierarchy
