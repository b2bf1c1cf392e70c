#version 460
#extension GL_GOOGLE_include_directive : require
// The reference's light that bounces: path push.first of each pixel in this frame goes on to its
// vertex number push.count, which the lights light. A dispatch a vertex, so that the number of
// iterations of one invocation stays bounded.
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
#include "shaders/all_lights.glsl"

// Moves a path on to its next vertex; its surface's depth is 0 where the path ends. Returns the
// receiver there, and its triangle and instance in `hit`.
Receiver move_on(inout PathVertex vertex, Receiver r, uvec2 pixel, out Hit hit) {
  const float choice = random_float();
  vec2 u = vec2(random_float(), random_float());
  // The first direction is stratified over paths and frames. A later one must not be in step with
  // it.
  if (push.count == 1u) {
    const uvec4 start = pcg4d(uvec4(pixel, 0u, FRAME.seed * 16u + STREAM_PATH));
    u = r2_point(start.xy, FRAME.frame * FRAME.reference_paths + push.first);
  }
  const Scatter next = scatter(r, film_share_of(r), choice, u);
  vertex.throughput *= next.weight;
  vertex.surface = NO_SURFACE;
  // The first two bounces are worth their rays even off dark surfaces.
  const bool goes_on = push.count <= 2u ? luminance(vertex.throughput) > 0.0
                                        : survives(vertex.throughput);
  if (!goes_on) return r;
  vertex.surface = first_surface(r.origin, next.direction, MASK_SHADOW, WIDE_SPREAD, hit);
  vertex.viewer = r.origin;
  vertex.throughput *= transmittance(r.position, vertex.surface.position);
  return vertex.surface.depth > 0.0 ? next_receiver(r, vertex.surface, next.density, WET_ALPHA) : r;
}

// Returns the light that a path's vertex reflects from the lights, the sky and the moon, and what
// it emits by itself.
vec3 light_of_vertex(PathVertex vertex, Receiver r, Hit hit, uvec2 pixel) {
  vec3 sum = unsampled_emission(vertex.surface, hit) + reflected_sky_and_moon(r);
  LightLayers ignored = NO_LAYERS;
  if (SCENE.light_count <= REFERENCE_CHUNK)
    return sum + reflected_from_all(pixel, r, 0u, SCENE.light_count, false, ignored);
  for (uint i = 0u; i < REFERENCE_PICKS; ++i)
    sum += reflected_direct(r, REFERENCE_PICK_CANDIDATES) / float(REFERENCE_PICKS);
  return sum;
}

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  PathVertex vertex = PathVertex(FRAME.surfaces.at[index], vec3(1.0), FRAME.camera.position);
  if (push.count > 1u) vertex = FRAME.path.at[index];
  if (vertex.surface.depth <= 0.0) {  // the path ended, or never began in the sky
    FRAME.path.at[index] = vertex;
    return;
  }
  // Pixels have coordinates below 2^16.
  seed_random(pixel | uvec2(push.first, push.count) << 16u, STREAM_PATH);
  Receiver r = receiver_seen_from(vertex.surface, vertex.viewer, false);
  vec3 sum = vertex.throughput *
             reflected_from_lit_surface(r, film_share_of(r), WET_ALPHA, REFERENCE_PICK_CANDIDATES);
  Hit hit;
  r = move_on(vertex, r, pixel, hit);
  FRAME.path.at[index] = vertex;
  if (vertex.surface.depth > 0.0) sum += vertex.throughput * light_of_vertex(vertex, r, hit, pixel);
  LightLayers layers = NO_LAYERS;
  layers.indirect = sum * (transmittance(FRAME.surfaces.at[index].position, FRAME.camera.position) /
                           float(FRAME.reference_paths));
  Accumulation total = FRAME.radiance.at[index];
  add_compensated(total, layers.indirect);
  FRAME.radiance.at[index] = total;
  add_layers(index, layers, false);
}
