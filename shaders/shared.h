// Macros with which C++ and GLSL read the same declarations. Records lie in scalar block layout,
// which is C's own layout of 4-byte members. Every buffer is reached by its address: BUFFER(Lights)
// is a reference in GLSL and 64 bits in C++.
#ifndef NIGHTCITY_SHADERS_SHARED_H
#define NIGHTCITY_SHADERS_SHARED_H

#include "formats/light.h"

#ifdef __cplusplus
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
namespace nightcity::gpu {
using vec2 = glm::vec2;
using vec4 = glm::vec4;
using uvec2 = glm::uvec2;
}  // namespace nightcity::gpu
#define BUFFER(type) std::uint64_t
#define ARRAY_REFERENCE(name, type, access)
#define ARRAY_REFERENCE_16(name, type, access)
#else
#define BUFFER(type) type
// Declare `name`, a reference to an array of `type` in device memory. Where records are whole units
// of 16 bytes, as ARRAY_REFERENCE_16 has them, a device loads such a unit at once, and not in four.
#define ARRAY_REFERENCE(name, type, access) ALIGNED_ARRAY_REFERENCE(name, type, access, 4)
#define ARRAY_REFERENCE_16(name, type, access) ALIGNED_ARRAY_REFERENCE(name, type, access, 16)
#define ALIGNED_ARRAY_REFERENCE(name, type, access, alignment)                              \
  layout(buffer_reference, scalar, buffer_reference_align = alignment) access buffer name { \
    type at[];                                                                              \
  };
#endif

#endif
