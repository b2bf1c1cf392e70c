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
#include "shaders/surface_hit.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/camera.glsl"
#include "shaders/sky.glsl"
#include "shaders/panes.glsl"
#include "shaders/accumulation.glsl"
#include "shaders/layers.glsl"
#include "shaders/all_lights.glsl"

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
  float passed = 1.0;
  vec3 airlight = vec3(0.0);
  if (surface.depth > 0.0) passed = transmittance(surface.position, FRAME.camera.position);
  if (chunk == 0u) {
    if (surface.depth > 0.0) airlight = sky_airlight(camera_direction(pixel), passed);
    layers.emitted = surface.depth > 0.0 ? seen_emission(surface) : seen_sky(pixel);
    if (surface.depth > 0.0) {
      seed_random(pixel, STREAM_SKY);
      layers.sky = reflected_sky_and_moon(receiver_of(surface));
    }
    total.sum = (layers.emitted + layers.sky) * passed + airlight;
  }
  if (surface.depth > 0.0)
    add_compensated(
        total, passed * reflected_from_all(pixel, receiver_of(surface), chunk, end, true, layers));
  see_through_air(layers, passed, airlight);
  FRAME.radiance.at[sum_index] = total;
  add_layers(index, layers, chunk == 0u && FRAME.reset != 0u);
}
