#include "runtime/scene/mesh_placement.h"

#include <algorithm>
#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace nightcity::scene {
namespace {

// A ray that meets an instance changes its frame, which costs more than the few triangles of a lamp
// post. So the triangles of small meshes are stored for each of their instances, up to this many.
constexpr std::size_t most_copied_triangles = 1'000'000, most_triangles_of_a_copy = 64;

// Returns whether a mesh keeps its shape under a matrix, but for a factor of 1e-6 an axis.
bool keeps_volume(const glm::dmat4& matrix) {
  const double determinant = glm::determinant(glm::dmat3(matrix));
  return std::isfinite(determinant) && std::abs(determinant) >= 1e-18;
}

}  // namespace

MeshPlacement::MeshPlacement(const Scene& scene, const MeshSource& meshes,
                             const GeometryFilter& filter, const glm::dvec3& origin,
                             bool has_traffic)
    : scene_(scene), meshes_(meshes), filter_(filter), origin_(origin) {
  for (const SceneNode& node : scene.nodes)
    skipped_.push_back(is_left_out(node, filter.left_out) ||
                       (has_traffic && node.vehicle != no_id));
  find_units();
  find_merged();
}

bool MeshPlacement::casts_shadow(std::size_t node) const {
  const SceneNode& of = scene_.nodes[node];
  return of.casts_shadow &&
         !(of.vehicle != no_id && holds(filter_.left_out, Part::vehicle_shadows));
}

void MeshPlacement::find_units() {
  constexpr double usual = 1024;
  units_.assign(meshes_.triangles.size(), 0.0);
  for (const SceneNode& node : scene_.nodes)
    for (const SceneInstance& instance : node.instances)
      for (int axis = 0; axis < 3; ++axis)
        units_.at(node.mesh) = std::max(
            units_.at(node.mesh), glm::length(glm::dvec3(glm::dmat4(instance.to_model)[axis])));
  for (double& unit : units_) {
    const bool is_usual = unit >= 1 / usual && unit <= usual;
    const bool is_scale = unit > 0 && std::isfinite(unit);
    unit = is_usual || !is_scale ? 1 : std::exp2(std::round(std::log2(unit)));
  }
}

void MeshPlacement::find_merged() {
  std::size_t placed_once = 0;
  for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
    const SceneNode& node = scene_.nodes[i];
    merged_.push_back(node.instances.size() == 1 && node.instances[0].light == no_id &&
                      node.instances[0].feature == no_id && !is_horizon(node));
    if (merged_[i] && !skipped_[i]) placed_once += meshes_.triangles.at(node.mesh);
  }
  // In a small scene copies would be most of the triangles.
  std::size_t room = std::min(most_copied_triangles, placed_once / 2);
  for (std::size_t i = 0; i < scene_.nodes.size(); ++i) {
    const SceneNode& node = scene_.nodes[i];
    const std::size_t one = meshes_.triangles.at(node.mesh), all = one * node.instances.size();
    const bool is_small = one > 0 && one <= most_triangles_of_a_copy && all <= room;
    if (merged_[i] || skipped_[i] || !is_small || is_horizon(node)) continue;
    merged_[i] = true;
    room -= all;
  }
}

std::vector<Placement> MeshPlacement::find_placements(std::size_t node) {
  const SceneNode& of = scene_.nodes[node];
  const glm::dmat4 from_unit = glm::scale(glm::dmat4(1), glm::dvec3(1 / unit(of.mesh)));
  std::vector<Placement> placements;
  placements.reserve(of.instances.size());
  for (const SceneInstance& instance : of.instances) {
    const std::uint32_t light = find_light(instance.light, filter_.light_numbers);
    if (light == left_out_light) continue;
    glm::dmat4 to_scene = to_double(instance);
    to_scene[3] -= glm::dvec4(origin_, 0);
    const glm::dmat4 to_scene_from_unit = to_scene * from_unit;
    // A flat copy of a mesh that stands once still shows.
    const bool may_be_flat = merged_[node] && of.instances.size() == 1;
    if (!may_be_flat && !keeps_volume(to_scene_from_unit))
      ++dropped_;
    else
      placements.push_back(
          {merged_[node] ? to_scene : to_scene_from_unit, light, instance.feature});
  }
  return placements;
}

}  // namespace nightcity::scene
