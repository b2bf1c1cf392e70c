#version 460
#extension GL_GOOGLE_include_directive : require
// The reference: every light, one stratified sample each a frame, a chunk of lights a dispatch (push.first, push.count).
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const Surface surface = FRAME.surfaces.at[index];
  Accumulation total = FRAME.radiance.at[index];
  if (push.first == 0u) {
    vec3 direct = surface.depth > 0.0 ? emitted(surface) : FRAME.sky;
    if (HAS_SKY != 0u && surface.depth > 0.0) {
      seed_random(pixel, STREAM_SKY);
      direct += reflected_sky(receiver_of(surface), vec2(random_float(), random_float()));
    }
    total = Accumulation(direct, 1.0, vec3(0.0), 0.0);
  }
  if (surface.depth > 0.0) {
    const Receiver receiver = receiver_of(surface);
    vec3 sum = vec3(0.0);
    for (uint i = 0u; i < min(push.count, REFERENCE_CHUNK); ++i) {
      const uint light = push.first + i;
      // Stratified over frames: the R2 sequence (Roberts 2018) from a start of its own for each pixel and light.
      const uvec4 start = pcg4d(uvec4(pixel, light, FRAME.seed * 16u + STREAM_REFERENCE));
      const uvec2 uv = start.xy + FRAME.frame * uvec2(3242174889u, 2447445414u);
      const vec2 unit = vec2(uv >> 8u) * (1.0 / 16777216.0);
      const LightSample s = sample_light(light_at(light), unit, receiver.position);
      const vec3 f = reflected(receiver, s);
      if (luminance(f) > 0.0 && !occluded(receiver.origin, s.point)) sum += f;
    }
    // Kahan: 10^6 lights are thousands of chunks, and late small ones must not be lost.
    precise const vec3 y = sum - total.compensation;
    precise const vec3 t = total.sum + y;
    precise const vec3 lost = (t - total.sum) - y;
    total.compensation = lost;
    total.sum = t;
  }
  FRAME.radiance.at[index] = total;
}
