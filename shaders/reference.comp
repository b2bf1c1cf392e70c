#version 460
#extension GL_GOOGLE_include_directive : require
// The reference: every light in every frame, with one stratified sample each, and more on a light
// close by. A dispatch adds up the lights from push.first to before push.first + push.count,
// REFERENCE_CHUNK of them per invocation. The chunks of a dispatch lie side by side in slices (z),
// so that a small picture fills a large device too. With push.bounce > 0 the lights light that
// vertex of the pixel's path (extend.comp); without lights to add up (push.count = 0), a few are
// resampled there.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/surface_hit.glsl"
#include "shaders/camera.glsl"
#include "shaders/lights.glsl"
#include "shaders/light_sampling.glsl"
#include "shaders/shading.glsl"
#include "shaders/sky.glsl"
#include "shaders/reservoir.glsl"
#include "shaders/resampling.glsl"
#include "shaders/path.glsl"
#include "shaders/accumulation.glsl"
#include "shaders/layers.glsl"

// Returns whether a light fills much of a hemisphere; the surface may hide half of it, as the top
// of a lamp's own post does.
bool is_close(Light light, vec3 position) {
  const vec3 way = light.position - position;
  return dot(way, way) < CLOSE_RADII * CLOSE_RADII * bounding_radius2(light);
}

// Returns point i of a light's points in this frame. On the surface that is seen they are
// stratified over frames, from a start of its own for each pixel and light. A vertex that moves from
// frame to frame must not be in step with them.
vec2 point_of_light(uvec2 pixel, uint light, uint i, uint points) {
  if (push.bounce > 0u) return vec2(random_float(), random_float());
  const uvec4 start = pcg4d(uvec4(pixel, light, FRAME.seed * 16u + STREAM_REFERENCE));
  return r2_point(start.xy, FRAME.frame * points + i);
}

// Returns the light that the receiver reflects from the lights from `first` to before `end`.
vec3 reflected_from(uvec2 pixel, Receiver receiver, uint first, uint end,
                    inout LightLayers layers) {
  vec3 sum = vec3(0.0);
  uint close_left = MAX_CLOSE_LIGHTS;
  for (uint index_of_light = first; index_of_light < end; ++index_of_light) {
    const Light light = light_at(index_of_light);
    uint points = 1u;
    if (close_left > 0u && is_close(light, receiver.position)) {
      points = CLOSE_POINTS;
      --close_left;
    }
    for (uint i = 0u; i < points; ++i) {
      const vec2 uv = point_of_light(pixel, index_of_light, i, points);
      const LightSample s = sample_point(light, uv, receiver.position);
      const vec3 f = reflected(receiver, s) / float(points);
      if (luminance(f) > 0.0 && !occluded(receiver.origin, s.point, false)) {
        add_direct(layers, index_of_light, light, f);
        sum += f;
      }
    }
  }
  return sum;
}

// Adds the light that a chunk of lights sends by the pixel's path, and what does not depend on
// lights once.
void add_bounced(uvec2 pixel, uint index, uint chunk, uint end, uint sum_index) {
  const PathVertex vertex = FRAME.path.at[index];
  if (vertex.surface.depth <= 0.0) return;
  const Receiver receiver = receiver_seen_from(vertex.surface, vertex.viewer, false);
  const uvec2 stream = uvec2(pixel.x, pixel.y | chunk / REFERENCE_CHUNK << 16u);
  seed_random_of_bounce(stream, push.bounce, STREAM_REFERENCE);
  LightLayers of_lights = NO_LAYERS;
  vec3 sum = vec3(0.0);
  if (chunk == 0u) sum = unsampled_emission(vertex.surface) + reflected_sky_and_moon(receiver);
  if (push.count == 0u) {
    for (uint i = 0u; i < REFERENCE_PICKS; ++i)
      sum += reflected_direct(receiver, REFERENCE_PICK_CANDIDATES) / float(REFERENCE_PICKS);
  } else {
    sum += reflected_from(pixel, receiver, chunk, end, of_lights);
  }
  LightLayers layers = NO_LAYERS;
  layers.indirect = vertex.throughput * sum;
  Accumulation total = FRAME.radiance.at[sum_index];
  add_compensated(total, layers.indirect);
  FRAME.radiance.at[sum_index] = total;
  add_layers(index, layers, false);
}

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const uint slice = INVOCATION.z;
  const uint sum_index = slice * pixels_of_picture() + index;
  const uint chunk = push.first + slice * REFERENCE_CHUNK;
  const uint end = min(push.first + push.count, chunk + REFERENCE_CHUNK);
  if (INDIRECT != INDIRECT_NONE && push.bounce > 0u) {
    add_bounced(pixel, index, chunk, end, sum_index);
    return;
  }
  const Surface surface = FRAME.surfaces.at[index];
  Accumulation total = FRAME.radiance.at[sum_index];
  LightLayers layers = NO_LAYERS;
  if (push.first == 0u) total = single_frame(vec3(0.0));
  if (chunk == 0u) {
    layers.emitted = surface.depth > 0.0 ? emitted(surface) : seen_sky(pixel);
    if (surface.depth > 0.0) {
      seed_random(pixel, STREAM_SKY);
      layers.sky = reflected_sky_and_moon(receiver_of(surface));
    }
    total.sum = layers.emitted + layers.sky;
  }
  if (surface.depth > 0.0)
    add_compensated(total, reflected_from(pixel, receiver_of(surface), chunk, end, layers));
  FRAME.radiance.at[sum_index] = total;
  add_layers(index, layers, chunk == 0u && FRAME.reset != 0u);
}
