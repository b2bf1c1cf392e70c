#include "runtime/scene/bvh_node.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "runtime/scene/bounds.h"

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

bool any(Int4 lanes) {
  return (lanes[0] | lanes[1] | lanes[2] | lanes[3]) != 0;
}

// The planes of four boxes, in steps from 0 to 255.
struct Planes {
  Int4 lower, upper;
};

// A power of two divides exactly. The conversion truncates, and the loops round outwards, as the
// traversal computes.
Planes quantise(Float4 lower, Float4 upper, float origin, float step, float per_m) {
  const Float4 first{}, last = first + 255.0f;
  const Float4 to_upper = (upper - origin) * per_m;
  Planes q{to_int(min_of(max_of((lower - origin) * per_m, first), last)),
           to_int(min_of(max_of(to_upper, first), last))};
  const auto place = [&](Int4 steps) {
    return origin + __builtin_convertvector(steps, Float4) * step;
  };
  while (true) {
    const Int4 inside = (q.lower > 0) & (place(q.lower) > lower);
    if (!any(inside)) break;
    q.lower += inside;
  }
  while (true) {
    const Int4 inside = (q.upper < 255) & ((__builtin_convertvector(q.upper, Float4) < to_upper) |
                                           (place(q.upper) < upper));
    if (!any(inside)) return q;
    q.upper -= inside;
  }
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
    const float origin = down(box.lower[axis]), top = up(box.upper[axis]);
    // The smallest power of two whose 255 steps reach the far side, as the shader computes it.
    const float extent = top - origin;
    int exponent = std::clamp(exponent_of(std::max(extent / 255.0f, 1e-30f)), -100, 120);
    while (origin + 255.0f * power_of_two(exponent) < top) ++exponent;
    node.origin[axis] = origin;
    node.exponents |= static_cast<std::uint32_t>(exponent + 127) << (8 * axis);
    Float4 lower{}, upper{};
    for (std::size_t i = 0; i < children.size(); ++i) {
      lower[i] = children[i].box.lower[axis];
      upper[i] = children[i].box.upper[axis];
    }
    const Planes planes =
        quantise(down(lower), up(upper), origin, power_of_two(exponent), power_of_two(-exponent));
    node.lower[axis] = pack_bytes(planes.lower & present);
    node.upper[axis] = pack_bytes(planes.upper & present);
  }
  return node;
}

}  // namespace nightcity::scene
