#version 460
#extension GL_GOOGLE_include_directive : require
// Final shading: f(y) V(y) W of the surviving sample, plus what the surface emits by itself.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/reservoir.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const Surface surface = FRAME.surfaces.at[index];
  vec3 radiance = FRAME.sky;
  if (surface.depth > 0.0) {
    radiance = emitted(surface);
    const Receiver receiver = receiver_of(surface);
    if (HAS_SKY != 0u) {
      seed_random(pixel, STREAM_SKY);
      radiance += reflected_sky(receiver, vec2(random_float(), random_float()));
    }
    const Reservoir reservoir = FRAME.spatial.at[index];
    if (reservoir.W > 0.0 && reservoir.light < SCENE.light_count) {
      const LightSample s = sample_light(light_at(reservoir.light), uv_of(reservoir.uv), receiver.position);
      // `traced` knows its sample to be visible: an occluded one has W = 0.
      if (ESTIMATOR == ESTIMATOR_TRACED || !occluded(receiver.origin, s.point))
        radiance += reflected(receiver, s) * reservoir.W;
    }
  }
  FRAME.radiance.at[index] = Accumulation(radiance, 1.0, vec3(0.0), 0.0);
}
