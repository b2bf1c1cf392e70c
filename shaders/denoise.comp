#version 460
#extension GL_GOOGLE_include_directive : require
// Denoiser, one level (push.first, from 0): a 5 x 5 B3-spline kernel with holes of 2^level pixels. The last level puts the albedo and
// the emission back, in FRAME.radiance, and shows the result.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/display.glsl"
#include "shaders/denoise.glsl"

const float LUMINANCE_TOLERANCE = 4.0;  // in standard deviations of what is being filtered (Schied et al.)
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
    const int hole = 1 << level;
    for (int dy = -2; dy <= 2; ++dy)
      for (int dx = -2; dx <= 2; ++dx) {
        const ivec2 at = ivec2(pixel) + ivec2(dx, dy) * hole;
        if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(FRAME.size)))) continue;
        const uint there = uint(at.y) * FRAME.size.x + uint(at.x);
        const Surface other = FRAME.surfaces.at[there];
        if (other.depth <= 0.0 || other.light != NO_HIT) continue;
        const Demodulated d = FRAME.denoise[from].at[there];
        // Same plane, same direction, and no farther apart in light than noise explains.
        const float off_plane = abs(dot(normal, other.position - surface.position));
        const float reach = 0.002 * surface.depth * float(hole) + 0.01;
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

  const Accumulation mean = FRAME.accumulation.at[index];
  vec3 radiance = mean.sum / max(mean.frames, 1.0);
  if (surface.depth > 0.0 && surface.light == NO_HIT) radiance = result.irradiance * albedo_of(surface) + emitted(surface);
  FRAME.radiance.at[index] = Accumulation(radiance, 1.0, vec3(0.0), 0.0);
  FRAME.display.at[index] = displayed(radiance);
}
