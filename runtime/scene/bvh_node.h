// Nodes of the shaders' BVH: boxes of up to four children in 8 bits per plane.
#pragma once

#include <span>

#include "formats/hierarchy/bounds.h"
#include "formats/hierarchy/builder.h"
#include "shaders/bvh_types.h"

namespace nightcity::scene {

/// Returns a node whose children's boxes are quantised about the corner of `box`, which contains
/// them all. They are rounded outwards, as the traversal computes them in float, so that a child's
/// box contains the child (Ylitie, Karras, Laine: Efficient incoherent ray traversal on GPUs
/// through compressed wide BVHs, HPG 2017). At most four children; which nodes they are is left
/// open (BVH_EMPTY). Their masks are MASK_* bits of everything below.
gpu::BvhNode quantise_node(const hierarchy::Bounds& box,
                           std::span<const hierarchy::MeasuredChild> children);

}  // namespace nightcity::scene
