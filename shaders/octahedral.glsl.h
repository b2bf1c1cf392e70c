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
// Packs a vector of any length but zero.
uint pack_normal(vec3 n) {
  n /= abs(n.x) + abs(n.y) + abs(n.z);
  return packSnorm2x16(n.z >= 0.0 ? n.xy : fold_octahedron(n.xy));
}
#endif

// Returns the unit vector that pack_normal packed.
OCTAHEDRAL_FUNCTION vec3 unpack_normal(uint packed) {
  vec2 p = unpackSnorm2x16(packed);
  const float z = 1.0f - abs(p.x) - abs(p.y);
  if (z < 0.0f) p = fold_octahedron(p);
  return normalize(vec3(p, z));
}

#ifdef __cplusplus
}  // namespace nightcity::octahedral
#endif
#undef OCTAHEDRAL_FUNCTION

#endif
