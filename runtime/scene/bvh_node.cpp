#include "runtime/scene/bvh_node.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "formats/hierarchy/bounds.h"

namespace nightcity::scene {
namespace {

using hierarchy::Float4;
using hierarchy::Int4;
using hierarchy::max_of;
using hierarchy::min_of;
using hierarchy::to_int;

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

// The same for four numbers at a time. Unsigned, because both steps are taken of -0.
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

// The planes of four boxes, in steps from 0 to 255.
struct Planes {
  Int4 lower, upper;
};

// Rounds outwards, with a margin. Truncation rounds numbers above 0 down; one below the last step
// rounds them up.
Planes quantise(Float4 lower, Float4 upper, float origin, float per_m) {
  const auto truncate = [](Float4 steps) {
    return to_int(min_of(max_of(steps, Float4{}), Float4{} + 255.0f));
  };
  return {truncate((lower - origin) * per_m - BVH_MARGIN),
          255 - truncate(255.0f - ((upper - origin) * per_m + BVH_MARGIN))};
}

std::uint32_t pack_bytes(Int4 lanes) {
  const Int4 at = lanes << Int4{0, 8, 16, 24};
  return static_cast<std::uint32_t>(at[0] | at[1] | at[2] | at[3]);
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
  Int4 present{};  // -1 for each child
  for (std::size_t i = 0; i < children.size(); ++i) {
    node.masks |= children[i].mask << (8 * i);
    present[i] = -1;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const float corner = down(box.lower[axis]), top = up(box.upper[axis]);
    // The smallest power of two of which 255 reach from the origin to the far side, margins
    // included. The origin lies below the corner by two of them: a plane of 0 steps needs its
    // margin too.
    int exponent = std::clamp(exponent_of(std::max((top - corner) / 255.0f, 1e-30f)), -100, 120);
    const auto origin_of = [corner](int e) {
      return down(corner - 2.0f * BVH_MARGIN * power_of_two(e));
    };
    while ((255.0f - 2.0f * BVH_MARGIN) * power_of_two(exponent) < top - origin_of(exponent))
      ++exponent;
    const float origin = origin_of(exponent);
    node.origin[axis] = origin;
    node.exponents |= static_cast<std::uint32_t>(exponent + 127) << (8 * axis);
    Float4 lower{}, upper{};
    for (std::size_t i = 0; i < children.size(); ++i) {
      lower[i] = children[i].box.lower[axis];
      upper[i] = children[i].box.upper[axis];
    }
    const Planes planes = quantise(down(lower), up(upper), origin, power_of_two(-exponent));
    node.lower[axis] = pack_bytes(planes.lower & present);
    node.upper[axis] = pack_bytes(planes.upper & present);
  }
  return node;
}

}  // namespace nightcity::scene
