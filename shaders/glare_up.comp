#version 460
#extension GL_GOOGLE_include_directive : require
// Replaces level push.first of the glare's pyramid by its share of the scattered light and that of
// all levels above.
#include "shaders/common.glsl"
#include "shaders/accumulation.glsl"
#include "shaders/glare.glsl"

void main() {
  const uvec2 pixel = INVOCATION.xy, size = FRAME.glare.size[push.first];
  if (any(greaterThanEqual(pixel, size))) return;
  vec3 sum = FRAME.glare.weight[push.first] * level_at(push.first, ivec2(pixel));
  if (push.first < FRAME.glare.last) sum += spread_from(push.first + 1u, ivec2(pixel));
  FRAME.glare.levels.at[FRAME.glare.first[push.first] + pixel.y * size.x + pixel.x] = sum;
}
