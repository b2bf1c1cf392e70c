#version 460
#extension GL_GOOGLE_include_directive : require
// The denoiser's first step: takes the emission off the mean and divides it by the albedo, and
// estimates the variance of its luminance.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/similar.glsl"
#include "shaders/accumulation.glsl"
#include "shaders/denoise.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const Surface surface = FRAME.surfaces.at[index];
  Demodulated result = Demodulated(vec3(0.0), 0.0);
  if (surface.depth > 0.0 && surface.light == NO_HIT) {
    const Accumulation a = FRAME.accumulation.at[index];
    const vec3 albedo = albedo_of(surface);
    const float passed = transmittance(surface.position, FRAME.camera.position);
    result.irradiance = max(mean_of(a) - emitted(surface) * passed, vec3(0.0)) / albedo;
    // The variance of the mean, from the spread of the frames. A few frames say too little: then
    // also from the spread of the pixels around.
    const float l = luminance(a.sum) / frames_of(a);
    float variance =
        max(a.luminance_squared / frames_of(a) - l * l, 0.0) / max(a.frames - 1.0, 1.0);
    if (a.frames < 4.0) {
      float sum = 0.0, squares = 0.0, count = 0.0;
      for (int dy = -3; dy <= 3; ++dy)
        for (int dx = -3; dx <= 3; ++dx) {
          const ivec2 at = ivec2(pixel) + ivec2(dx, dy);
          if (!in_picture(at)) continue;
          const uint there = uint(at.y) * FRAME.size.x + uint(at.x);
          if (!similar(surface, FRAME.surfaces.at[there])) continue;
          const float value = luminance(mean_of(FRAME.accumulation.at[there]));
          sum += value;
          squares += value * value;
          count += 1.0;
        }
      if (count > 1.0)
        variance = max(variance, max(squares / count - sum * sum / (count * count), 0.0));
    }
    const float scale = luminance(albedo);
    result.variance = variance / (scale * scale);
  }
  FRAME.denoise[0].at[index] = result;
}
