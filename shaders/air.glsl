// Air that scatters light: haze and fog. Light is weakened on its way from a lamp to what it lights
// and on from there to the eye, and air that a lamp lights glows (single scattering).
#include "shaders/air.glsl.h"

// m: how far air is followed along a ray that leaves the scene.
const float AIR_FAR = 1.0e5;

// m: the part of such a ray in which lights of a place are looked for.
const float AIR_REACH = 1000.0;

// Returns the optical depth of a way.
float depth_of_air(vec3 from, vec3 to) {
  if (AIR == AIR_EVEN) return FRAME.air.extinction * length(to - from);
  return optical_depth(FRAME.air.extinction, FRAME.air.falloff, from.y - FRAME.air.level,
                       to.y - FRAME.air.level, length(to - from));
}

// Returns the share of light that gets from one point to another, 0 .. 1.
float transmittance(vec3 from, vec3 to) {
  return AIR == AIR_CLEAR ? 1.0 : exp(-depth_of_air(from, to));
}

// Returns the share of light that air scatters at a point, 1/m.
float scattering_at(vec3 point) {
  const float even = FRAME.air.albedo * FRAME.air.extinction;
  if (AIR == AIR_EVEN) return even;
  return even * exp(min(-FRAME.air.falloff * (point.y - FRAME.air.level), 60.0));
}

// Returns the phase function of a cosine between the ways before and after scattering (Henyey,
// Greenstein 1941), 1/sr. Positive asymmetries scatter forwards.
float phase(float cosine) {
  const float g = FRAME.air.asymmetry;
  const float s = 1.0 + g * g - 2.0 * g * cosine;
  return (1.0 - g * g) / (4.0 * PI * s * sqrt(s));
}
