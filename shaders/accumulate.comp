#version 460
#extension GL_GOOGLE_include_directive : require
// Adds the frame's estimate to the running mean, and writes the displayed pixel.
#include "shaders/common.glsl"
#include "shaders/tonemap.glsl.h"

uint byte_of(float exposed) { return uint(srgb_encode(tone_curve(FRAME.tone, exposed)) * 255.0 + 0.5); }

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  vec3 radiance = FRAME.radiance.at[index].sum;
  // The last guard: no NaN or Inf reaches a pixel, and none stays in a sum.
  if (!(finite(radiance.x) && finite(radiance.y) && finite(radiance.z))) radiance = vec3(0.0);

  Accumulation total = FRAME.accumulation.at[index];
  if (FRAME.reset != 0u) total = Accumulation(vec3(0.0), 0.0, vec3(0.0), 0.0);
  precise const vec3 y = radiance - total.compensation;
  precise const vec3 t = total.sum + y;
  precise const vec3 lost = (t - total.sum) - y;
  total.compensation = lost;
  total.sum = t;
  total.frames += 1.0;
  total.luminance_squared += luminance(radiance) * luminance(radiance);
  FRAME.accumulation.at[index] = total;

  const vec3 mean = total.sum / total.frames * FRAME.exposure;
  FRAME.display.at[index] =
      byte_of(mean.r) | byte_of(mean.g) << 8 | byte_of(mean.b) << 16 | 0xFF000000u;
}
