#include "runtime/scene/mesh_placement.h"

#include <glm/common.hpp>
#include <glm/ext/matrix_transform.hpp>

namespace nightcity::scene {

PlacedBox place_box(const Box& box, const SceneInstance& instance) {
  const glm::dvec3 lower(box.lower), upper(box.upper);
  const glm::dmat4 to_model = to_double(instance);
  PlacedBox placed{glm::dvec3(to_model * glm::dvec4((lower + upper) / 2.0, 1)), glm::dvec3(0)};
  for (int axis = 0; axis < 3; ++axis)
    placed.half += glm::abs(glm::dvec3(to_model[axis])) * ((upper[axis] - lower[axis]) / 2);
  return placed;
}

MeshPlacement::MeshPlacement(const Scene& scene, const MeshSource& meshes,
                             const GeometryFilter& filter, const glm::dvec3& origin,
                             bool has_traffic)
    : scene_(scene), filter_(filter), origin_(origin) {
  for (const SceneNode& node : scene.nodes)
    skipped_.push_back(is_left_out(node, filter.left_out) ||
                       (has_traffic && node.vehicle != no_id));
  units_ = hierarchy::find_units(scene.nodes, meshes.triangles.size());
  merged_ = hierarchy::find_static_nodes(scene.nodes, meshes.triangles, skipped_);
}

bool MeshPlacement::casts_shadow(std::size_t node) const {
  const SceneNode& of = scene_.nodes[node];
  return of.casts_shadow &&
         !(of.vehicle != no_id && holds(filter_.left_out, Part::vehicle_shadows));
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
    const bool is_any_shown = merged_[node] && hierarchy::may_be_flat(of);
    if (!is_any_shown && !hierarchy::keeps_volume(to_scene, unit(of.mesh)))
      ++dropped_;
    else
      placements.push_back(
          {merged_[node] ? to_scene : to_scene * from_unit, light, instance.feature});
  }
  return placements;
}

}  // namespace nightcity::scene
