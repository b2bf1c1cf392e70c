#version 460
#extension GL_GOOGLE_include_directive : require
// The reference: every light, one stratified sample each a frame, more on one close by. A dispatch works at the lights from
// push.first to before push.first + push.count, REFERENCE_CHUNK of them an invocation: chunks side by side in slices (z), so
// that a small picture fills a large device too.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/camera.glsl"
#include "shaders/layers.glsl"

// A light that fills much of a hemisphere, half of it behind the surface: the top of a lamp's own post.
bool is_close(Light light, vec3 position) {
  const vec3 way = light.position - position;
  return dot(way, way) < 16.0 * (light.radius * light.radius + light.half_height * light.half_height);
}

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const uint slice = INVOCATION.z;
  const uint sum_index = slice * pixels_of_picture() + index;
  const uint chunk = push.first + slice * REFERENCE_CHUNK;
  const uint end = min(push.first + push.count, chunk + REFERENCE_CHUNK);
  const Surface surface = FRAME.surfaces.at[index];
  Accumulation total = FRAME.radiance.at[sum_index];
  LightLayers layers = LightLayers(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
  if (push.first == 0u) total = Accumulation(vec3(0.0), 1.0, vec3(0.0), 0.0);
  if (chunk == 0u) {
    layers.emitted = surface.depth > 0.0 ? emitted(surface) : seen_sky(pixel);
    if (HAS_SKY != SKY_DARK && surface.depth > 0.0) {
      seed_random(pixel, STREAM_SKY);
      const Receiver receiver = receiver_of(surface);
      layers.sky = reflected_sky(receiver, vec2(random_float(), random_float())) +
                   reflected_moon(receiver, vec2(random_float(), random_float()));
    }
    total.sum = layers.emitted + layers.sky;
  }
  if (surface.depth > 0.0) {
    const Receiver receiver = receiver_of(surface);
    vec3 sum = vec3(0.0);
    uint close_left = REFERENCE_MOST_CLOSE;
    for (uint index_of_light = chunk; index_of_light < end; ++index_of_light) {
      const Light light = light_at(index_of_light);
      // Stratified over frames: the R2 sequence (Roberts 2018) from a start of its own for each pixel and light.
      const uvec4 start = pcg4d(uvec4(pixel, index_of_light, FRAME.seed * 16u + STREAM_REFERENCE));
      uint points = 1u;
      if (close_left > 0u && is_close(light, receiver.position)) {
        points = REFERENCE_CLOSE;
        --close_left;
      }
      for (uint i = 0u; i < points; ++i) {
        const uvec2 uv = start.xy + (FRAME.frame * points + i) * uvec2(3242174889u, 2447445414u);
        const vec2 unit = vec2(uv >> 8u) * (1.0 / 16777216.0);
        const LightSample s = sample_point(light, unit, receiver.position);
        const vec3 f = reflected(receiver, s) / float(points);
        if (luminance(f) > 0.0 && !occluded(receiver.origin, s.point)) {
          add_direct(layers, index_of_light, light, f);
          sum += f;
        }
      }
    }
    // Kahan: 10^6 lights are thousands of chunks, and late small ones must not be lost.
    precise const vec3 y = sum - total.compensation;
    precise const vec3 t = total.sum + y;
    precise const vec3 lost = (t - total.sum) - y;
    total.compensation = lost;
    total.sum = t;
  }
  FRAME.radiance.at[sum_index] = total;
  keep_layers(index, layers, chunk == 0u && FRAME.reset != 0u);
}
