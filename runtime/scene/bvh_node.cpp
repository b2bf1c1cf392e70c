#include "runtime/scene/bvh_node.h"

#include <algorithm>
#include <bit>
#include <limits>

namespace nightcity::scene {
namespace {

// std::nextafter, without a call and for finite numbers only.
float step_bits(float x, bool towards_zero) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  return std::bit_cast<float>(towards_zero ? bits - 1 : bits + 1);
}
float up(float x) {
  return x == 0 ? std::numeric_limits<float>::denorm_min() : step_bits(x, x < 0);
}
float down(float x) {
  return -up(-x);
}

// Returns 2^exponent for -126 <= exponent <= 127.
float power_of_two(int exponent) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(exponent + 127) << 23);
}
int exponent_of(float x) {  // of a normal number > 0
  return static_cast<int>(std::bit_cast<std::uint32_t>(x) >> 23) - 127;
}

}  // namespace

gpu::BvhNode quantise_node(const Box& box, std::span<const BvhChild> children) {
  gpu::BvhNode node{};
  std::fill(std::begin(node.child), std::end(node.child), BVH_EMPTY);
  for (std::size_t i = 0; i < children.size(); ++i) node.masks |= children[i].mask << (8 * i);
  for (int axis = 0; axis < 3; ++axis) {
    const float origin = down(box.lower[axis]), top = up(box.upper[axis]);
    // The smallest power of two whose 255 steps reach the far side, as the shader computes it.
    const float extent = top - origin;
    int exponent = std::clamp(exponent_of(std::max(extent / 255.0f, 1e-30f)), -100, 120);
    while (origin + 255.0f * power_of_two(exponent) < top) ++exponent;
    const float step = power_of_two(exponent), per_m = power_of_two(-exponent);
    node.origin[axis] = origin;
    node.exponents |= static_cast<std::uint32_t>(exponent + 127) << (8 * axis);
    for (std::size_t i = 0; i < children.size(); ++i) {
      const float lower = down(children[i].box.lower[axis]);
      const float upper = up(children[i].box.upper[axis]);
      // A power of two divides exactly. The conversion truncates, and the loops round outwards.
      int q0 = static_cast<int>(std::clamp((lower - origin) * per_m, 0.0f, 255.0f));
      int q1 = static_cast<int>(std::clamp((upper - origin) * per_m, 0.0f, 255.0f));
      while (q0 > 0 && origin + static_cast<float>(q0) * step > lower) --q0;
      while (q1 < 255 && static_cast<float>(q1) < (upper - origin) * per_m) ++q1;
      while (q1 < 255 && origin + static_cast<float>(q1) * step < upper) ++q1;
      node.lower[axis] |= static_cast<std::uint32_t>(q0) << (8 * i);
      node.upper[axis] |= static_cast<std::uint32_t>(q1) << (8 * i);
    }
  }
  return node;
}

}  // namespace nightcity::scene
