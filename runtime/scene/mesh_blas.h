// Adds the hierarchies over the triangles of meshes to a scene (BLAS).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "formats/hierarchy/static_geometry.h"
#include "formats/stored_hierarchy.h"
#include "runtime/scene/bvh.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::scene {

constexpr std::uint32_t triangle_leaf = 4;
// A ray may defer BVH_STACK entries. This is how the TLAS and the hierarchy of a mesh share them: one
// is for the other child of the root above the static scene and the vehicles. What is left is for
// instances among static triangles (top_level.h).
constexpr std::uint32_t tlas_stack = 33;
constexpr std::uint32_t mesh_stack = hierarchy::static_stack;
static_assert(triangle_leaf == hierarchy::static_leaf && 1 + tlas_stack + mesh_stack <= BVH_STACK);

/// Consecutive triangles of a scene, from `first` to before `end`.
struct TriangleRange {
  std::size_t first, end;
};

/// Says why a hierarchy of the file is not used. What a user leaves out is no fault of the file's.
void say_unused(RenderScene& scene, const std::string& fault);

/// Builds the BLAS over some triangles, and returns its root.
BvhRoot add_blas(RenderScene& scene, const TriangleRange& range, unsigned threads,
                 std::uint32_t stack = mesh_stack, const hierarchy::BoxFrame& frame = {});

/// Adds the BLAS over some triangles that stand where they are stored, and returns its
/// root. It is built, unless `stored` is of these triangles. Then they are looked at on the way, so
/// that VertexCheck::later is enough; nothing is returned where that was asked for, and `stored` is
/// not of them.
std::optional<BvhRoot> add_static_blas(RenderScene& scene, const TriangleRange& range,
                                       VertexCheck vertices, unsigned threads,
                                       const StoredHierarchy* stored,
                                       const hierarchy::BoxFrame& frame);

}  // namespace nightcity::scene
