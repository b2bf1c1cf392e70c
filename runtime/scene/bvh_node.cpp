#include "runtime/scene/bvh_node.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>

namespace nightcity::scene {
namespace {

// Vectors hold x, y and z. The fourth place holds anything but a denormal number, which is slow.
using hierarchy::Bounds;
using hierarchy::Float4;
using hierarchy::Int4;
using hierarchy::max_of;
using hierarchy::min_of;
using hierarchy::to_int;

// std::nextafter, for finite numbers only. Unsigned, because both steps are taken of -0.
Float4 down(Float4 x) {
  using Bits = std::uint32_t __attribute__((vector_size(16)));
  const Bits bits = std::bit_cast<Bits>(x);
  const Float4 stepped = std::bit_cast<Float4>(x > 0.0f ? bits - 1u : bits + 1u);
  const Float4 below_zero = Float4{} - std::numeric_limits<float>::denorm_min();
  return x == 0.0f ? below_zero : stepped;
}
Float4 up(Float4 x) {
  return -down(-x);
}

// Returns 2^exponent for -126 <= exponent <= 127.
Float4 power_of_two(Int4 exponent) {
  return std::bit_cast<Float4>((exponent + 127) << 23);
}
Int4 exponent_of(Float4 x) {  // of normal numbers > 0
  return (std::bit_cast<Int4>(x) >> 23) - 127;
}
Int4 clamp(Int4 x, int lower, int upper) {
  x = x < lower ? Int4{} + lower : x;
  return x > upper ? Int4{} + upper : x;
}

// Tells how the planes of a node's children are counted.
struct Steps {
  Float4 origin;
  Int4 exponent;
};

// Finds the smallest powers of two of which 255 reach from the origin to the far side, margins
// included. The origin lies below the corner by two of them: a plane of 0 steps needs its margin
// too.
Steps find_steps(const Bounds& box) {
  constexpr Float4 fourth{0, 0, 0, 1};
  const Float4 corner = down(box.lower + fourth), top = up(box.upper + fourth);
  Steps steps;
  steps.exponent =
      clamp(exponent_of(max_of((top - corner) / 255.0f, Float4{} + 1e-30f)), -100, 120);
  while (true) {
    const Float4 step = power_of_two(steps.exponent);
    steps.origin = down(corner - 2.0f * BVH_MARGIN * step);
    const Int4 too_few = (255.0f - 2.0f * BVH_MARGIN) * step < top - steps.origin;
    if ((too_few[0] | too_few[1] | too_few[2]) == 0) return steps;
    steps.exponent -= too_few;  // which is -1
  }
}

// Truncation rounds numbers above 0 down.
Int4 truncate(Float4 steps) {
  return to_int(min_of(max_of(steps, Float4{}), Float4{} + 255.0f));
}

}  // namespace

gpu::BvhNode quantise_node(const Bounds& box, std::span<const hierarchy::MeasuredChild> children) {
  gpu::BvhNode node{};
  std::fill(std::begin(node.child), std::end(node.child), BVH_EMPTY);
  const auto [origin, exponent] = find_steps(box);
  const Float4 per_m = power_of_two(-exponent);
  Int4 lower{}, upper{};  // a byte for each child
  for (std::size_t i = 0; i < children.size(); ++i) {
    const int shift = 8 * static_cast<int>(i);
    const Bounds& child = children[i].box;
    // Rounded outwards, with a margin. One below the last step rounds up.
    lower |= truncate((down(child.lower) - origin) * per_m - BVH_MARGIN) << shift;
    upper |= (255 - truncate(255.0f - ((up(child.upper) - origin) * per_m + BVH_MARGIN))) << shift;
    node.masks |= children[i].mask << shift;
  }
  for (int axis = 0; axis < 3; ++axis)
    node.exponents |= static_cast<std::uint32_t>(exponent[axis] + 127) << (8 * axis);
  std::memcpy(&node.origin, &origin, sizeof node.origin);
  std::memcpy(node.lower, &lower, sizeof node.lower);
  std::memcpy(node.upper, &upper, sizeof node.upper);
  return node;
}

}  // namespace nightcity::scene
