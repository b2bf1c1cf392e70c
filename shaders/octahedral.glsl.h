// Octahedral unit vectors (Cigolle et al.: A Survey of Efficient Representations for Independent
// Unit Vectors, JCGT 2014), packed as 2 x 16 bits. Both C++ and GLSL include this file.
#ifndef NIGHTCITY_SHADERS_OCTAHEDRAL_GLSL_H
#define NIGHTCITY_SHADERS_OCTAHEDRAL_GLSL_H

#ifdef __cplusplus
#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
namespace nightcity::octahedral {
using glm::abs;
using glm::normalize;
using glm::vec2;
using glm::vec3;
using uint = std::uint32_t;
#define OCTAHEDRAL_FUNCTION inline
inline vec2 unpackSnorm2x16(uint packed) {  // as GLSL's
  const auto snorm = [](uint bits) {
    return std::clamp(float(static_cast<std::int16_t>(bits)) / 32767.0f, -1.0f, 1.0f);
  };
  return {snorm(packed & 0xFFFFu), snorm(packed >> 16)};
}
#else
#define OCTAHEDRAL_FUNCTION
#endif

OCTAHEDRAL_FUNCTION vec2 sign_not_zero(vec2 v) {
  return vec2(v.x >= 0.0f ? 1.0f : -1.0f, v.y >= 0.0f ? 1.0f : -1.0f);
}

// Returns the part of the octahedron's lower half that lies folded over the upper: its own inverse.
OCTAHEDRAL_FUNCTION vec2 fold_octahedron(vec2 p) {
  return (1.0f - abs(vec2(p.y, p.x))) * sign_not_zero(p);
}

#ifndef __cplusplus
vec2 to_octahedron(vec3 n) {
  n /= abs(n.x) + abs(n.y) + abs(n.z);
  return n.z >= 0.0 ? n.xy : fold_octahedron(n.xy);
}

// Packs a vector of any length but zero.
uint pack_normal(vec3 n) { return packSnorm2x16(to_octahedron(n)); }

// A step of 16 bits is 3e-5 rad, which is 16 % of the light that falls in at 89.99 degrees. Eleven
// more bits make it finer than floats tell apart.
const float NORMAL_REST_STEP = 1.0 / (32767.0 * 2046.0);

// Returns what pack_normal rounds off, in 2 x 11 bits.
uint pack_normal_rest(vec3 n, uint packed) {
  const vec2 rest = to_octahedron(n) - unpackSnorm2x16(packed);
  const ivec2 steps = ivec2(clamp(round(rest / NORMAL_REST_STEP), vec2(-1023.0), vec2(1023.0)));
  return (uint(steps.x) & 2047u) | (uint(steps.y) & 2047u) << 11u;
}
#endif

OCTAHEDRAL_FUNCTION vec3 from_octahedron(vec2 p) {
  const float z = 1.0f - abs(p.x) - abs(p.y);
  if (z < 0.0f) p = fold_octahedron(p);
  return normalize(vec3(p, z));
}

// Returns the unit vector that pack_normal packed.
OCTAHEDRAL_FUNCTION vec3 unpack_normal(uint packed) {
  return from_octahedron(unpackSnorm2x16(packed));
}

#ifndef __cplusplus
// The same, with the lower 22 bits of `rest` from pack_normal_rest.
vec3 unpack_normal(uint packed, uint rest) {
  const ivec2 steps = ivec2(bitfieldExtract(int(rest), 0, 11), bitfieldExtract(int(rest), 11, 11));
  return from_octahedron(unpackSnorm2x16(packed) + vec2(steps) * NORMAL_REST_STEP);
}
#endif

#ifdef __cplusplus
}  // namespace nightcity::octahedral
#endif
#undef OCTAHEDRAL_FUNCTION

#endif
