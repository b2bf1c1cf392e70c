#version 460
#extension GL_GOOGLE_include_directive : require
// One level of the denoiser (push.first, from 0): a 5 x 5 B3-spline kernel whose taps are 2^level
// pixels apart. The last level multiplies by the albedo, adds the emission, and writes
// FRAME.radiance and the display.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/display.glsl"
#include "shaders/accumulation.glsl"
#include "shaders/denoise.glsl"

// In standard deviations of the filtered light (Schied et al.).
const float LUMINANCE_TOLERANCE = 4.0;
const float SPLINE[3] = float[](3.0 / 8.0, 1.0 / 4.0, 1.0 / 16.0);

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const uint level = push.first, from = level & 1u, to = 1u - from;
  const Surface surface = FRAME.surfaces.at[index];
  const Demodulated centre = FRAME.denoise[from].at[index];
  Demodulated result = centre;
  if (surface.depth > 0.0 && surface.light == NO_HIT) {
    const vec3 normal = unpack_normal(surface.normal);
    const float l = luminance(centre.irradiance);
    const float deviation = LUMINANCE_TOLERANCE * sqrt(centre.variance) + 1e-6 * l + 1e-12;
    vec3 sum = vec3(0.0);
    float weights = 0.0, variances = 0.0;
    const int step = 1 << level;
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx) {
        const ivec2 at = ivec2(pixel) + ivec2(dx, dy) * step;
        if (!in_picture(at)) continue;
        const uint there = uint(at.y) * FRAME.size.x + uint(at.x);
        const Surface other = FRAME.surfaces.at[there];
        if (other.depth <= 0.0 || other.light != NO_HIT) continue;
        const Demodulated d = FRAME.denoise[from].at[there];
        // Weights for the same plane, the same direction, and a difference in light that noise
        // explains.
        const float off_plane = abs(dot(normal, other.position - surface.position));
        const float reach = 0.002 * surface.depth * float(step) + 0.01;
        const float facing = pow(max(dot(normal, unpack_normal(other.normal)), 0.0), 64.0);
        const float w = SPLINE[abs(dx)] * SPLINE[abs(dy)] * facing * exp(-off_plane / reach) *
                        exp(-abs(luminance(d.irradiance) - l) / deviation);
        sum += d.irradiance * w;
        variances += d.variance * w * w;
        weights += w;
      }
    if (weights > 0.0) result = Demodulated(sum / weights, variances / (weights * weights));
  }
  FRAME.denoise[to].at[index] = result;
  if (level + 1u < DENOISE_LEVELS) return;

  vec3 radiance = mean_of(FRAME.accumulation.at[index]);
  if (surface.depth > 0.0 && surface.light == NO_HIT)
    radiance = result.irradiance * albedo_of(surface) +
               emitted(surface) * transmittance(surface.position, FRAME.camera.position);
  FRAME.radiance.at[index] = single_frame(radiance);
  FRAME.display.at[index] = displayed(radiance);
}
