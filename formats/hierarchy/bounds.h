// Boxes as two registers of four floats, of which the fourth stays 0: building a BVH spends most of
// its time on them. GCC's and clang's vector extension compiles to SSE or NEON.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/vec3.hpp>

namespace nightcity::hierarchy {

using Float4 = float __attribute__((vector_size(16)));

using Int4 = int __attribute__((vector_size(16)));

/// Rounds towards zero.
inline Int4 to_int(Float4 a) {
  return __builtin_convertvector(a, Int4);
}
inline Float4 min_of(Float4 a, Float4 b) {
  return a < b ? a : b;
}
inline Float4 max_of(Float4 a, Float4 b) {
  return a > b ? a : b;
}

/// Returns whether a comparison holds in some place, or in each of the four.
inline bool any_of(Int4 a) {
  const auto halves = std::bit_cast<std::array<std::uint64_t, 2>>(a);
  return (halves[0] | halves[1]) != 0;
}
inline bool all_of(Int4 a) {
  return !any_of(~a);
}

/// Returns a with 0 in the fourth place: an integer there would be a slow denormal number.
inline Float4 take_xyz(Int4 a) {
  return std::bit_cast<Float4>(a & Int4{-1, -1, -1, 0});
}
/// Returns three floats as x, y, z; no byte behind them is read.
inline Float4 load_vec3(const std::byte* bytes) {
  using Long2 = std::uint64_t __attribute__((vector_size(16)));
  std::uint64_t xy;
  std::uint32_t z;
  std::memcpy(&xy, bytes, sizeof xy);
  std::memcpy(&z, bytes + sizeof xy, sizeof z);
  return std::bit_cast<Float4>(Long2{xy, z});
}

inline Float4 to_float4(const glm::vec3& p) {
  return Float4{p.x, p.y, p.z, 0};
}

struct Bounds {
  Float4 lower{3.4e38f, 3.4e38f, 3.4e38f, 0}, upper{-3.4e38f, -3.4e38f, -3.4e38f, 0};

  void grow(Float4 p) {
    lower = min_of(lower, p);
    upper = max_of(upper, p);
  }
  void grow(const Bounds& b) {
    lower = min_of(lower, b.lower);
    upper = max_of(upper, b.upper);
  }
  /// Returns the box that is wider by so much on all sides.
  Bounds widened(float by) const {
    const Float4 margin{by, by, by, 0};
    return {lower - margin, upper + margin};
  }
  Float4 centre() const { return 0.5f * lower + 0.5f * upper; }
  /// Returns half the surface area; the box must not be empty.
  float half_area() const {
    const Float4 s = upper - lower;
    return s[0] * s[1] + s[1] * s[2] + s[2] * s[0];
  }
};

}  // namespace nightcity::hierarchy
