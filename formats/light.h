// One light, as it lies in city.lights, in memory and on the GPU. Included by C++ and GLSL (scalar block
// layout): the one definition of the record and of its enumerations. Little-endian, 64 bytes, no padding.
#ifndef NIGHTCITY_FORMATS_LIGHT_H
#define NIGHTCITY_FORMATS_LIGHT_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/vec3.hpp>
namespace nightcity {
using vec3 = glm::vec3;
using uint = std::uint32_t;
#endif

// What emits. The kind lies in the low 8 bits of kind_profile.
#define LIGHT_SPHERE \
  0u  // lamp: sphere of `radius`; isotropic without a profile, else I(C, gamma) of its profile
#define LIGHT_RECTANGLE \
  1u  // window: one-sided Lambertian rectangle, half extents `radius` x `half_height`

#define LIGHT_NO_PROFILE 0xFFFFFFu   // profile index of a light without a luminaire profile
#define LIGHT_ALWAYS_ON 0xFFFFFFFFu  // schedule index of a light without a schedule

struct Light {
  vec3 position;  // centre; model space (X east, Y up, Z south), m
  float radius;   // sphere: luminous radius (0 = point); rectangle: half extent along `tangent`; m
  vec3
      axis;  // unit. Sphere: the luminaire's gamma = 0 direction (down for a street lamp); rectangle: normal
  float half_height;  // rectangle: half extent along cross(axis, tangent); 0 for a sphere; m
  vec3 tangent;  // unit, perpendicular to axis. Sphere: the C = 0 half-plane; rectangle: first edge
  float flux_lm;  // luminous flux, lumen, finite and > 0
  uint
      colour_rgb9e5;  // linear Rec. 709 chromaticity; a reader scales it to luminance 1, so flux stays
                      // photometric
  uint kind_profile;  // kind | profile index << 8
  uint schedule;      // index into the schedules, or LIGHT_ALWAYS_ON
  uint id;            // stable identity: the same lamp or window has it after every bake
};

// A luminaire profile: luminous intensity in candela per lumen on a regular grid, C fastest in memory last:
// value(c, g) = data[data_offset + c * gamma_count + g], C = c * 360 / c_count degrees (wraps round),
// gamma = g * extent / (gamma_count - 1) degrees. Bilinear between, dark beyond. Its integral over the sphere is 1.
struct LightProfile {
  uint c_count;      // >= 1; 1 = rotationally symmetric
  uint gamma_count;  // >= 2
  uint data_offset;  // first value, in floats from the start of the profile data section
  float
      extent_deg;  // gamma of the last row, in (0, 180]: a headlamp's beam needs its rows close to the axis
};

#ifdef __cplusplus
static_assert(sizeof(Light) == 64);
static_assert(sizeof(LightProfile) == 16);
}  // namespace nightcity
#endif

#endif
