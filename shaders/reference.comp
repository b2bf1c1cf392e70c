#version 460
#extension GL_GOOGLE_include_directive : require
// The reference: every light in every frame, with one stratified sample each, and more on a light
// close by. A dispatch adds up the lights from push.first to before push.first + push.count,
// REFERENCE_CHUNK of them per invocation. The chunks of a dispatch lie side by side in slices (z),
// so that a small picture fills a large device too.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/camera.glsl"
#include "shaders/sky.glsl"
#include "shaders/accumulation.glsl"
#include "shaders/layers.glsl"

// Returns whether a light fills much of a hemisphere; the surface may hide half of it, as the top
// of a lamp's own post does.
bool is_close(Light light, vec3 position) {
  const vec3 way = light.position - position;
  return dot(way, way) < CLOSE_RADII * CLOSE_RADII * bounding_radius2(light);
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
  LightLayers layers = NO_LAYERS;
  if (push.first == 0u) total = single_frame(vec3(0.0));
  if (chunk == 0u) {
    layers.emitted = surface.depth > 0.0 ? emitted(surface) : seen_sky(pixel);
    if (SKY_MODE != SKY_DARK && surface.depth > 0.0)
      layers.sky = reflected_sky_and_moon(receiver_of(surface), pixel);
    total.sum = layers.emitted + layers.sky;
  }
  if (surface.depth > 0.0) {
    const Receiver receiver = receiver_of(surface);
    vec3 sum = vec3(0.0);
    uint close_left = MAX_CLOSE_LIGHTS;
    for (uint index_of_light = chunk; index_of_light < end; ++index_of_light) {
      const Light light = light_at(index_of_light);
      // Stratified over frames, from a start of its own for each pixel and light.
      const uvec4 start = pcg4d(uvec4(pixel, index_of_light, FRAME.seed * 16u + STREAM_REFERENCE));
      uint points = 1u;
      if (close_left > 0u && is_close(light, receiver.position)) {
        points = CLOSE_POINTS;
        --close_left;
      }
      for (uint i = 0u; i < points; ++i) {
        const vec2 uv = r2_point(start.xy, FRAME.frame * points + i);
        const LightSample s = sample_point(light, uv, receiver.position);
        const vec3 f = reflected(receiver, s) / float(points);
        if (luminance(f) > 0.0 && !occluded(receiver.origin, s.point, false)) {
          add_direct(layers, index_of_light, light, f);
          sum += f;
        }
      }
    }
    add_compensated(total, sum);
  }
  FRAME.radiance.at[sum_index] = total;
  add_layers(index, layers, chunk == 0u && FRAME.reset != 0u);
}
