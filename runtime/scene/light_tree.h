// The light BVH over the lights that do not move: light is sampled from it for a segment of a ray,
// for which a map grid is too coarse. Air close by a window gets most of its light from that
// window.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shaders/interface.h"

namespace nightcity::scene {

struct LightTree {
  gpu::LightTree shape{};                    // its addresses are not set
  std::vector<gpu::LightNode> nodes;         // leaves first, then level by level up to the root
  std::vector<std::uint32_t> leaf_of_light;  // of all lights, 0 of those that are off
};

/// Builds the tree over those of `lights` whose indices are `lit`. Neighbours on a Morton curve
/// become siblings, four of them a node.
LightTree build_light_tree(std::span<const Light> lights, std::span<const std::uint32_t> lit);

}  // namespace nightcity::scene
