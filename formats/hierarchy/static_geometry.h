// The static triangles of a scene, as nightview stores them: where they stand, in two hierarchies,
// one of what casts shadows and one of the rest. nightbake builds the same.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "formats/finite.h"
#include "formats/hierarchy/box_frame.h"
#include "formats/scene.h"

namespace nightcity::hierarchy {

/// Triangles in a leaf at most, and entries that a ray may defer within a hierarchy of triangles.
constexpr std::uint32_t static_leaf = 4, static_stack = 46;

/// Returns whether a node is the ground around a scene, to the horizon. It has a hierarchy of its
/// own, since its box would make those of the scene coarse, and is no part of the scene's bounds.
inline bool is_horizon(const SceneNode& node) {
  return node.kind == "horizon";
}

/// Returns, for each mesh, the power of two by which its triangles are multiplied where they are
/// stored once for all instances: near the scale of its largest instance, so that areas and the
/// determinants of ray tests stay within a float in whatever unit the mesh is. It is 1 for usual
/// scales.
std::vector<double> find_units(const std::vector<SceneNode>& nodes, std::size_t meshes);

/// Returns, for each node, whether its triangles are static: stored where they stand, for each of
/// its instances, of which there is one, or which are few triangles. `triangles`: of each mesh, by
/// its accessors. `skipped`: nodes that are not shown, in which case they are static only if they
/// have one instance.
std::vector<bool> find_static_nodes(const std::vector<SceneNode>& nodes,
                                    std::span<const std::size_t> triangles,
                                    const std::vector<bool>& skipped);

/// Returns whether a mesh whose unit is `unit` keeps its shape under a matrix, but for a factor of
/// 1e-6 an axis.
bool keeps_volume(const glm::dmat4& to_scene, double unit);

/// Returns whether a static copy of a node is shown that has no volume: a flat copy of a mesh that
/// stands once still shows.
inline bool may_be_flat(const SceneNode& node) {
  return node.instances.size() == 1;
}

/// Returns a vertex where it stands.
inline glm::vec3 place(const glm::dmat4& to_scene, const glm::vec3& vertex) {
  return glm::vec3(to_scene * glm::dvec4(vertex, 1.0));
}

/// Returns whether a triangle has an area and lies within max_coordinate_m. Others are left out.
inline bool is_shown(const Corners& c) {
  const auto next = [](Float4 v) { return __builtin_shufflevector(v, v, 1, 2, 0, 3); };
  const auto is_near = [](Float4 v) {
    return max_of(v, -v) <= static_cast<float>(max_coordinate_m);  // no float lies between the two
  };
  const Float4 a = c.v1 - c.v0, b = c.v2 - c.v0,
               normal = a * next(b) - next(a) * b;  // z, x and y of the cross product
  return any_of(normal * normal > 0.0f) && all_of(is_near(c.v0) & is_near(c.v1) & is_near(c.v2));
}
inline bool is_shown(const glm::vec3& v0, const glm::vec3& v1, const glm::vec3& v2) {
  return is_shown({to_float4(v0), to_float4(v1), to_float4(v2)});
}

}  // namespace nightcity::hierarchy
