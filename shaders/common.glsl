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

// Returns the luminance of linear Rec. 709 light (ITU-R BT.709).
float luminance(vec3 rgb) { return dot(rgb, vec3(0.2126, 0.7152, 0.0722)); }

bool finite(float x) { return abs(x) <= 3.0e38; }  // false for NaN too
bool all_finite(vec3 v) { return finite(v.x) && finite(v.y) && finite(v.z); }

#include "shaders/materials.glsl"
