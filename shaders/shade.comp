#version 460
#extension GL_GOOGLE_include_directive : require
// Final shading: f(y) V(y) W of the surviving sample, plus what the surface emits by itself.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/camera.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/reservoir.glsl"
#include "shaders/layers.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const Surface surface = FRAME.surfaces.at[index];
  LightLayers layers = LightLayers(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
  vec3 radiance;
  if (surface.depth > 0.0) {
    radiance = layers.emitted = emitted(surface);
    const Receiver receiver = receiver_of(surface);
    if (HAS_SKY != SKY_DARK) {
      seed_random(pixel, STREAM_SKY);
      layers.sky = reflected_sky(receiver, vec2(random_float(), random_float())) +
                   reflected_moon(receiver, vec2(random_float(), random_float()));
      radiance += layers.sky;
    }
    const Reservoir reservoir = FRAME.spatial.at[index];
    if (reservoir.W > 0.0 && reservoir.light < SCENE.light_count) {
      const Light light = light_at(reservoir.light);
      const LightSample s = sample_point(light, uv_of(reservoir.uv), receiver.position);
      // `traced` knows its sample to be visible: an occluded one has W = 0.
      if (ESTIMATOR == ESTIMATOR_TRACED || !occluded(receiver.origin, s.point)) {
        const vec3 direct = reflected(receiver, s) * reservoir.W;
        add_direct(layers, reservoir.light, light, direct);
        radiance += direct;
      }
    }
  } else {
    radiance = layers.emitted = seen_sky(pixel);
  }
  FRAME.radiance.at[index] = Accumulation(radiance, 1.0, vec3(0.0), 0.0);
  keep_layers(index, layers, FRAME.reset != 0u);
}
