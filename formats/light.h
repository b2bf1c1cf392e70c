// One light, as it lies in city.lights, in memory and on the GPU. Both C++ and GLSL include this
// file (scalar block layout): it is the one definition of the record, of its enumerations and of
// how its packed words are read. Little-endian, 64 bytes, no padding.
#ifndef NIGHTCITY_FORMATS_LIGHT_H
#define NIGHTCITY_FORMATS_LIGHT_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/vec3.hpp>
namespace nightcity {
using vec3 = glm::vec3;
using uint = std::uint32_t;
#define LIGHT_FUNCTION inline
#define LIGHT_IN const Light&
#else
#define LIGHT_FUNCTION
#define LIGHT_IN Light
#endif

// Kinds of light: what the emitting surface is. To add one: give it the next number here, count it,
// add it to LightKind below, and compile. C++ switches over LightKind without a default, so the
// compiler names every place that has to treat the new kind; GLSL has one dispatch per operation,
// all in shaders/light_kinds.glsl, which checks the count.
#define LIGHT_SPHERE 0u     // lamp: intensity I(C, gamma) of its profile, isotropic without one
#define LIGHT_RECTANGLE 1u  // window: a one-sided Lambertian rectangle
#define LIGHT_KIND_COUNT 2

#define LIGHT_NO_PROFILE 0xFFFFFFu   // profile index of a light without a luminaire profile
#define LIGHT_ALWAYS_ON 0xFFFFFFFFu  // schedule index of a light without a schedule

struct Light {
  vec3 position;  // centre; model space (X east, Y up, Z south), m
  // Sphere: radius of the luminous sphere, 0 = a point. Rectangle: half_width(), its half extent
  // along `tangent`. In m.
  float radius;
  // Unit vector. Sphere: the luminaire's gamma = 0 direction (down for a street lamp). Rectangle:
  // its normal.
  vec3 axis;
  float half_height;  // rectangle: half extent along cross(axis, tangent); 0 for a sphere; m
  // Unit, perpendicular to axis. Sphere: the C = 0 half-plane. Rectangle: the direction of its
  // width.
  vec3 tangent;
  float flux_lm;  // luminous flux, lumen, finite and > 0
  // Linear Rec. 709 chromaticity. A reader scales it to luminance 1, so that the flux stays
  // photometric.
  uint colour_rgb9e5;
  uint kind_profile;  // written by pack_kind_profile, read by light_kind and light_profile
  uint schedule;      // index into the schedules, or LIGHT_ALWAYS_ON
  uint id;            // stable identity: the same lamp or window has it after every bake
};

// A luminaire profile: luminous intensity in candela per lumen on a regular grid, gamma fastest in
// memory: value(c, g) = data[data_offset + c * gamma_count + g] at C = c * 360 / c_count degrees
// (which wraps round) and gamma = g * extent / (gamma_count - 1) degrees. Values between are
// bilinear; beyond the extent it is dark. The integral over the sphere is 1.
struct LightProfile {
  uint c_count;      // >= 1; 1 = rotationally symmetric
  uint gamma_count;  // >= 2
  uint data_offset;  // first value, in floats from the start of the profile data section
  // Gamma of the last row, in (0, 180]. A headlamp's beam needs its rows close to the axis.
  float extent_deg;
};

#ifdef __cplusplus
// An exhaustive switch over this type has no default, so that -Werror=switch finds what a new kind
// misses.
enum class LightKind : uint { sphere = LIGHT_SPHERE, rectangle = LIGHT_RECTANGLE };

static_assert(sizeof(Light) == 64);
static_assert(sizeof(LightProfile) == 16);
#else
#define LightKind uint
#endif

// The word kind_profile: the kind in the low 8 bits, the profile's index above.
LIGHT_FUNCTION uint pack_kind_profile(uint kind, uint profile) {
  return kind | profile << 8;
}

// Returns a light's kind: LIGHT_* in GLSL. A file may hold a number that is no kind; light_fault
// refuses it.
LIGHT_FUNCTION LightKind light_kind(LIGHT_IN light) {
  return LightKind(light.kind_profile & 0xFFu);
}

// Returns the index of a light's profile, or LIGHT_NO_PROFILE.
LIGHT_FUNCTION uint light_profile(LIGHT_IN light) {
  return light.kind_profile >> 8;
}

// Returns half the width of a rectangle, along its tangent, m.
LIGHT_FUNCTION float half_width(LIGHT_IN light) {
  return light.radius;
}

#ifdef __cplusplus
inline uint pack_kind_profile(LightKind kind, uint profile) {
  return pack_kind_profile(uint(kind), profile);
}

/// Returns the kind's name, as reports print it.
inline const char* name_of(LightKind kind) {
  switch (kind) {
    case LightKind::sphere:
      return "sphere";
    case LightKind::rectangle:
      return "rectangle";
  }
  return "unknown";
}

inline void set_half_width(Light& light, float half_width_m) {
  light.radius = half_width_m;
}
}  // namespace nightcity
#endif

#undef LIGHT_FUNCTION
#undef LIGHT_IN

#endif
