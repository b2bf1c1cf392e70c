// Builds bounding volume hierarchies (BVH) of the shaders' nodes: a BLAS over a mesh's triangles,
// the TLAS over the instances.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "formats/large_vector.h"
#include "runtime/scene/box.h"
#include "runtime/scene/triangle_list.h"
#include "shaders/bvh_types.h"

namespace nightcity::scene {

struct Bvh {
  // Indices of children count within this vector, ranges of leaves within `order`.
  LargeVector<gpu::BvhNode> nodes;
  std::vector<std::uint32_t> order;  // primitive at each position of the leaves
  std::uint32_t root = BVH_EMPTY;    // a node, a leaf, or BVH_EMPTY
  std::uint32_t stack_need = 0;      // entries that a ray may have to defer
};

/// Builds a BVH over `boxes`, which are finite, with at most `max_leaf` (<= BVH_MAX_LEAF) of them
/// per leaf. Ranges are split straight into four by the binned surface-area heuristic, the largest
/// child first. Where the rest would need more than `max_stack` deferred entries, they are split at
/// the object median, whose depth is logarithmic. `masks` is empty or holds one MASK_* per box;
/// what casts shadows is then kept apart from what does not. The result does not depend on the
/// number of `threads`. Throws Error if medians alone are too deep (needed_stack), or for more than
/// 134 million boxes.
Bvh build_bvh(std::span<const Box> boxes, std::uint32_t max_leaf, std::uint32_t max_stack,
              std::span<const std::uint8_t> masks = {}, unsigned threads = 1);

struct BvhRoot {
  std::uint32_t node = BVH_EMPTY;  // a node, a leaf, or BVH_EMPTY
  std::uint32_t stack_need = 0;    // entries that a ray may have to defer
  Box box{};                       // of all primitives, in the scene's own frame
};

/// Builds a BVH over the triangles from `first` on as build_bvh does, and appends its nodes to
/// `nodes`, whose boxes are those of `frame`. `order`, which is as long as there are such triangles,
/// gets the number of the triangle at each position of the leaves. Positions count from `first` on,
/// and from as many more as leaves before have more positions than triangles (`more_before`). Two
/// triangles that follow each other and share an edge, as halves of quads do, are not parted.
BvhRoot append_bvh(LargeVector<gpu::BvhNode>& nodes, const TriangleList& triangles,
                   std::size_t first, std::uint32_t max_leaf, std::uint32_t max_stack,
                   unsigned threads, std::span<std::uint32_t> order,
                   const hierarchy::BoxFrame& frame = {}, std::size_t more_before = 0);

/// As append_bvh, of `count` triangles, with large ones cut as nightbake does
/// (formats/hierarchy/spatial_split.h). Positions are those that are appended to `order`: each part
/// is one of its triangle.
BvhRoot append_cut_bvh(LargeVector<gpu::BvhNode>& nodes, const TriangleList& triangles,
                       std::size_t first, std::size_t count, std::uint32_t max_leaf,
                       std::uint32_t max_stack, unsigned threads, LargeVector<std::uint32_t>& order,
                       const hierarchy::BoxFrame& frame);

/// Throws Error if a scene can not have as many triangles.
void check_triangle_count(std::size_t count);

/// Returns the deferred entries that a BVH of object medians over `boxes` boxes needs: the smallest
/// `max_stack` that build_bvh accepts.
std::uint32_t needed_stack(std::size_t boxes, std::uint32_t max_leaf);

}  // namespace nightcity::scene
