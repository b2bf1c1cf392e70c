#version 460
#extension GL_GOOGLE_include_directive : require
// Writes the displayed pixel anew from the mean, with another exposure or tone curve.
#include "shaders/common.glsl"
#include "shaders/accumulation.glsl"
#include "shaders/display.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  FRAME.display.at[index] = displayed(mean_of(FRAME.accumulation.at[index]));
}
