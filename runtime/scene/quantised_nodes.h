// The shaders' nodes, as builders of hierarchies make them.
#pragma once

#include <span>

#include "formats/hierarchy/builder.h"
#include "runtime/scene/box.h"
#include "runtime/scene/bvh_node.h"

namespace nightcity::scene {

inline Box to_box(const hierarchy::Bounds& b) {
  return {{b.lower[0], b.lower[1], b.lower[2]}, {b.upper[0], b.upper[1], b.upper[2]}};
}
inline hierarchy::Bounds to_bounds(const Box& b) {
  return {hierarchy::to_float4(b.lower), hierarchy::to_float4(b.upper)};
}

/// As hierarchy::Builder asks for it.
struct QuantisedNodes {
  using Node = gpu::BvhNode;
  static Node make(const hierarchy::Bounds& box,
                   std::span<const hierarchy::MeasuredChild> children) {
    return quantise_node(box, children);
  }
};

}  // namespace nightcity::scene
