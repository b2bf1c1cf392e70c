#include "runtime/scene/bvh_node.h"

#include <algorithm>
#include <cmath>

namespace nightcity::scene {
namespace {

float down(float x) {
  return std::nextafter(x, -INFINITY);
}
float up(float x) {
  return std::nextafter(x, INFINITY);
}

}  // namespace

gpu::BvhNode quantise_node(const Box& box, std::span<const BvhChild> children) {
  gpu::BvhNode node{};
  std::fill(std::begin(node.child), std::end(node.child), BVH_EMPTY);
  for (std::size_t i = 0; i < children.size(); ++i) node.masks |= children[i].mask << (8 * i);
  for (int axis = 0; axis < 3; ++axis) {
    const float origin = down(box.lower[axis]);
    // The smallest power of two whose 255 steps reach the far side, as the shader computes it.
    const float extent = up(box.upper[axis]) - origin;
    int exponent = std::clamp(std::ilogb(std::max(extent / 255.0f, 1e-30f)), -100, 120);
    while (origin + 255.0f * std::ldexp(1.0f, exponent) < up(box.upper[axis])) ++exponent;
    const float step = std::ldexp(1.0f, exponent);
    node.origin[axis] = origin;
    node.exponents |= static_cast<std::uint32_t>(exponent + 127) << (8 * axis);
    for (std::size_t i = 0; i < children.size(); ++i) {
      const float lower = down(children[i].box.lower[axis]);
      const float upper = up(children[i].box.upper[axis]);
      int q0 = std::clamp(static_cast<int>(std::floor((lower - origin) / step)), 0, 255);
      int q1 = std::clamp(static_cast<int>(std::ceil((upper - origin) / step)), 0, 255);
      while (q0 > 0 && origin + static_cast<float>(q0) * step > lower) --q0;
      while (q1 < 255 && origin + static_cast<float>(q1) * step < upper) ++q1;
      node.lower[axis] |= static_cast<std::uint32_t>(q0) << (8 * i);
      node.upper[axis] |= static_cast<std::uint32_t>(q1) << (8 * i);
    }
  }
  return node;
}

}  // namespace nightcity::scene
