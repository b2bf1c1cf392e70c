// First include of every pass: extensions, the shared records, the push constants.
#extension GL_EXT_buffer_reference : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#ifdef TRACE_QUERY
#extension GL_EXT_ray_query : require
#endif
#ifdef TRACE_PIPELINE  // the pass is a ray generation shader
#extension GL_EXT_ray_tracing : require
#define INVOCATION gl_LaunchIDEXT
#else
#define INVOCATION gl_GlobalInvocationID
#endif

#include "shaders/interface.h"

layout(constant_id = CONSTANT_ESTIMATOR) const uint ESTIMATOR = ESTIMATOR_TRACED;
layout(constant_id = CONSTANT_PROFILES) const uint HAS_PROFILES = 1u;
layout(constant_id = CONSTANT_RECTANGLES) const uint HAS_RECTANGLES = 1u;
layout(constant_id = CONSTANT_VISIBILITY_REUSE) const uint VISIBILITY_REUSE = 0u;
layout(constant_id = CONSTANT_SKY) const uint SKY_MODE = SKY_DARK;
layout(constant_id = CONSTANT_SCHEDULES) const uint HAS_SCHEDULES = 0u;
layout(constant_id = CONSTANT_TRAFFIC) const uint HAS_TRAFFIC = 0u;
layout(constant_id = CONSTANT_GLOSS) const uint HAS_GLOSS = 0u;
layout(constant_id = CONSTANT_LAYERS) const uint HAS_LAYERS = 0u;
layout(constant_id = CONSTANT_COUNT_RAYS) const uint COUNT_RAYS = 0u;
layout(constant_id = CONSTANT_INDIRECT) const uint INDIRECT = INDIRECT_NONE;
layout(constant_id = CONSTANT_AIR) const uint AIR = AIR_CLEAR;
layout(constant_id = CONSTANT_PROJECTION) const uint PROJECTION = PROJECTION_PERSPECTIVE;
layout(constant_id = CONSTANT_TEXTURES) const uint HAS_TEXTURES = 0u;
layout(constant_id = CONSTANT_GLARE) const uint GLARE = 0u;
layout(constant_id = CONSTANT_WHITE) const uint WHITE = 0u;
layout(constant_id = CONSTANT_MESOPIC) const uint MESOPIC = 0u;

// A pass over pixels runs in squares of them, a pass over a list in rows. Ray generation has no
// groups.
#ifdef TRACE_PIPELINE
#elif !defined(WORKGROUP_IS_A_ROW)
layout(local_size_x = WORKGROUP_SIZE, local_size_y = WORKGROUP_SIZE) in;
#else
layout(local_size_x = WORKGROUP_ROW) in;
#endif

layout(buffer_reference, scalar, buffer_reference_align = 8) readonly buffer FrameReference {
  Frame it;
};
layout(push_constant, scalar) uniform PushConstants {
  FrameReference frame;
  uint first;
  uint count;
} push;

#define FRAME push.frame.it
#define SCENE push.frame.it.scene

const float PI = 3.14159265358979;

// Returns false outside the picture.
bool pixel_of_invocation(out uvec2 pixel, out uint index) {
  pixel = INVOCATION.xy;
  index = pixel.y * FRAME.size.x + pixel.x;
  return all(lessThan(pixel, FRAME.size));
}

// Reads the size as a whole: Mesa 22.3's CPU driver reads FRAME.size.x where the text says
// FRAME.size.y (the tests Slices/Reference.* show it).
uint pixels_of_picture() {
  const uvec2 size = FRAME.size;
  return size.x * size.y;
}

bool in_picture(ivec2 at) {
  return all(greaterThanEqual(at, ivec2(0))) && all(lessThan(at, ivec2(FRAME.size)));
}

// Returns a vector of model space in the frame that the boxes of the scene's hierarchies lie in.
vec3 turn_to_boxes(vec3 v) {
  const vec2 along = SCENE.boxes_along;
  return vec3(along.x * v.x + along.y * v.z, v.y, along.x * v.z - along.y * v.x);
}

// Returns a whole number below 2^23 as a float: its bits are the fraction of a float from 2^23 on.
// GPUs convert at a fraction of the rate at which they add, and sampling lights converts a lot. It
// is precise, because a driver (NVIDIA 580) seems to join the constants of sums, and then a number
// that is added loses its digits.
float whole_to_float(uint n) {
  precise const float whole = uintBitsToFloat(n | 0x4B000000u) - 8388608.0;
  return whole;
}

// Returns the whole part of x in [0, 2^22), and the rest in [0, 1), without converting either.
uint split_whole(float x, out float rest) {
  precise const float rounded = x + 8388608.0;
  const uint nearest = floatBitsToUint(rounded) & 0x7FFFFFu;
  rest = x - whole_to_float(nearest);
  if (rest >= 0.0) return nearest;
  rest += 1.0;
  return nearest - 1u;
}

// Returns the angle from the x axis to (x, y) in turns, 0 to 1: within 2e-8 turns by the polynomial
// (Hastings: Approximations for Digital Computers, 1955, sheet 13). GLSL's atan may be wrong by
// 4096 units in the last place, and takes longer. Not both are 0.
float turns_to(float y, float x) {
  const float ax = abs(x), ay = abs(y);
  const float t = min(ax, ay) / max(max(ax, ay), 1e-30), t2 = t * t;
  float turns = -0.0040540580;
  turns = turns * t2 + 0.0218612288;
  turns = turns * t2 - 0.0559098861;
  turns = turns * t2 + 0.0964200441;
  turns = turns * t2 - 0.1390853351;
  turns = turns * t2 + 0.1994653599;
  turns = turns * t2 - 0.3332985605;
  turns = (turns * t2 + 0.9999993329) * t * (0.5 / PI);
  if (ay > ax) turns = 0.25 - turns;
  if (x < 0.0) turns = 0.5 - turns;
  return y < 0.0 ? 1.0 - turns : turns;
}

// Returns the luminance of linear Rec. 709 light (ITU-R BT.709).
float luminance(vec3 rgb) { return dot(rgb, vec3(0.2126, 0.7152, 0.0722)); }

bool finite(float x) { return abs(x) <= 3.0e38; }  // false for NaN too
bool all_finite(vec3 v) { return finite(v.x) && finite(v.y) && finite(v.z); }

#include "shaders/materials.glsl"
