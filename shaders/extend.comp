#version 460
#extension GL_GOOGLE_include_directive : require
// The reference's paths: finds the vertex after bounce push.bounce of each pixel's path.
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

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  PathVertex vertex =
      PathVertex(FRAME.surfaces.at[index], vec3(1.0), FRAME.camera.position);
  if (push.bounce > 1u) vertex = FRAME.path.at[index];
  if (vertex.surface.depth > 0.0) {
    const Receiver r = receiver_seen_from(vertex.surface, vertex.viewer, false);
    seed_random_of_bounce(pixel, push.bounce, STREAM_EXTEND);
    const float choice = random_float();
    vec2 u = vec2(random_float(), random_float());
    // The first direction is stratified over frames. A later one must not be in step with it.
    if (push.bounce == 1u) {
      const uvec4 start = pcg4d(uvec4(pixel, 0u, FRAME.seed * 16u + STREAM_EXTEND));
      u = r2_point(start.xy, FRAME.frame);
    }
    const Scatter next = scatter(r, choice, u);
    vertex.throughput *= next.weight;
    vertex.surface = NO_SURFACE;
    // The first bounces are worth their rays even off dark surfaces.
    const bool on = push.bounce <= 2u ? luminance(vertex.throughput) > 0.0
                                      : survives(vertex.throughput);
    if (on) {
      Hit hit;
      vertex.surface = first_surface(r.origin, next.direction, hit);
      vertex.viewer = r.origin;
    }
  }
  FRAME.path.at[index] = vertex;
}
