// Nodes of the shaders' BVH: boxes of up to four children in 8 bits per plane.
#pragma once

#include <cstdint>
#include <span>

#include "runtime/scene/box.h"
#include "shaders/bvh_types.h"

namespace nightcity::scene {

struct BvhChild {
  Box box;
  std::uint32_t mask = 0;  // MASK_* bits of everything below
};

/// Returns a node whose children's boxes are quantised about the corner of `box`, which contains
/// them all. They are rounded outwards, as the traversal computes them in float, so that a child's
/// box contains the child (Ylitie, Karras, Laine: Efficient incoherent ray traversal on GPUs
/// through compressed wide BVHs, HPG 2017). At most four children; which nodes they are is left
/// open (BVH_EMPTY).
gpu::BvhNode quantise_node(const Box& box, std::span<const BvhChild> children);

}  // namespace nightcity::scene
