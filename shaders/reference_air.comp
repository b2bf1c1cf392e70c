#version 460
#extension GL_GOOGLE_include_directive : require
// The reference's light that air scatters: every light in every frame, at one place on the ray
// each. Slices begin where those of reference.comp do. An invocation adds up AIR_CHUNK lights of
// its slice from push.first on, and none from push.count on.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/camera.glsl"
#include "shaders/lights.glsl"
#include "shaders/light_sampling.glsl"
#include "shaders/air_sampling.glsl"
#include "shaders/accumulation.glsl"
#include "shaders/layers.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const uint slice = INVOCATION.z;
  const uint sum_index = slice * pixels_of_picture() + index;
  const uint first = push.first + slice * REFERENCE_CHUNK;
  const uint end = min(push.count, first + AIR_CHUNK);
  const AirRay ray =
      air_ray(FRAME.camera.position, camera_direction(pixel), FRAME.surfaces.at[index]);
  Accumulation total = FRAME.radiance.at[sum_index];
  LightLayers layers = NO_LAYERS;
  for (uint i = first; i < end; ++i) {
    const Light light = light_at(i);
    if (!(light.flux_lm > 0.0)) continue;
    // Places are stratified over frames. The points of the light must not be in step with them.
    const uvec4 start = pcg4d(uvec4(pixel, i, FRAME.seed * 16u + STREAM_AIR));
    const vec2 u = r2_point(start.xy, FRAME.frame);
    const vec2 uv = vec2(u.y, fract(float(start.z >> 8u) * (1.0 / 16777216.0) +
                                    float(FRAME.frame & 0xFFFFu) * 0.4142135624));
    const AirDistance at = sample_distance(ray, light, u.x);
    if (!(at.density > 0.0)) continue;
    vec3 point;
    const vec3 f = scattered(ray, light, uv, at.distance, point) / at.density;
    if (!(luminance(f) > 0.0) || !all_finite(f)) continue;
    if (occluded(ray.origin + ray.direction * at.distance, point, false)) continue;
    layers.air += f;
  }
  add_compensated(total, layers.air);
  FRAME.radiance.at[sum_index] = total;
  add_layers(index, layers, false);
}
