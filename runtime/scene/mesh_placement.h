// Decides where the triangles of a scene's meshes are stored: where each instance stands, or once
// for all of the instances.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "formats/hierarchy/static_geometry.h"
#include "runtime/scene/mesh_triangles.h"
#include "runtime/scene/parts.h"

namespace nightcity::scene {

/// A choice of the geometry that is left out (parts.h).
struct GeometryFilter {
  PartSet left_out;
  std::span<const std::uint32_t> light_numbers;  // from leave_out_lights
};

using hierarchy::is_horizon;

/// The box of a mesh where an instance stands, in model space, m.
struct PlacedBox {
  glm::dvec3 middle, half;  // half: of its sides
};
/// `box` is that of the mesh in its own frame, and not empty.
PlacedBox place_box(const Box& box, const SceneInstance& instance);

class MeshPlacement {
 public:
  /// Keeps references to `scene` and `filter`. `origin` is that of the triangles, in model space. The
  /// file's vehicles show one moment: with `has_traffic` they are skipped.
  MeshPlacement(const Scene& scene, const MeshSource& meshes, const GeometryFilter& filter,
                const glm::dvec3& origin, bool has_traffic);

  bool is_skipped(std::size_t node) const { return skipped_[node]; }
  /// Returns whether the node's triangles are stored where they stand, for each of its instances:
  /// there is one, or they are few.
  bool is_merged(std::size_t node) const { return merged_[node]; }
  bool casts_shadow(std::size_t node) const;

  /// Returns the power of two by which the triangles of a mesh are multiplied that is stored once
  /// for all instances: near the scale of its largest instance, so that areas and the determinants
  /// of ray tests stay within a float in whatever unit the mesh is. It is 1 for usual scales, whose
  /// triangles can be read in place.
  double unit(std::uint32_t mesh) const { return units_[mesh]; }

  /// Returns where the mesh of a node stands, as it is stored; without instances that have no
  /// volume, which are counted, and those of lights that are left out.
  std::vector<Placement> find_placements(std::size_t node);
  std::size_t dropped() const { return dropped_; }

 private:
  const Scene& scene_;
  const GeometryFilter& filter_;
  glm::dvec3 origin_;
  std::vector<bool> skipped_, merged_;  // of each node
  std::vector<double> units_;           // of each mesh
  std::size_t dropped_ = 0;
};

}  // namespace nightcity::scene
