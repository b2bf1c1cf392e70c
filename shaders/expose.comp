#version 460
#extension GL_GOOGLE_include_directive : require
// Writes the displayed pixel anew from the mean, with another exposure or tone curve, and with what
// an eye adds.
#include "shaders/common.glsl"
#include "shaders/accumulation.glsl"
#include "shaders/display.glsl"
#include "shaders/glare.glsl"
#include "shaders/eye.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  vec3 light = mean_of(FRAME.accumulation.at[index]);
  if (GLARE != 0u) light = FRAME.glare.weight[0] * light + spread_from(1u, ivec2(pixel));
  FRAME.display.at[index] = displayed(seen_by_eye(light));
}
