// From cd/m^2 to a pixel of the display.
#include "shaders/tonemap.glsl.h"

// Bounded, because a driver's pow(1, x) may exceed 1 by more than half a step (seen on Mesa's CPU
// driver), and 256 would spill into the next channel.
uint byte_of(float exposed) {
  return min(uint(srgb_encode(tone_curve(FRAME.tone, exposed)) * 255.0 + 0.5), 255u);
}

// Returns 8-bit sRGB, R in the low byte, from cd/m^2 per channel.
uint displayed(vec3 radiance) {
  const vec3 exposed = radiance * FRAME.exposure;
  return byte_of(exposed.r) | byte_of(exposed.g) << 8 | byte_of(exposed.b) << 16 | 0xFF000000u;
}
