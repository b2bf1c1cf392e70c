#version 460
#extension GL_GOOGLE_include_directive : require
// Final shading: f(y) V(y) W of the selected sample, plus what the surface emits by itself.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/camera.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/sky.glsl"
#include "shaders/reservoir.glsl"
#include "shaders/accumulation.glsl"
#include "shaders/layers.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const Surface surface = FRAME.surfaces.at[index];
  LightLayers layers = NO_LAYERS;
  vec3 radiance;
  if (surface.depth > 0.0) {
    radiance = layers.emitted = emitted(surface);
    const Receiver receiver = receiver_of(surface);
    if (SKY_MODE != SKY_DARK) {
      layers.sky = reflected_sky_and_moon(receiver, pixel);
      radiance += layers.sky;
    }
    const Reservoir reservoir = FRAME.spatial.at[index];
    if (reservoir.W > 0.0 && reservoir.light < SCENE.light_count) {
      const Light light = light_at(reservoir.light);
      const LightSample s = sample_point(light, uv_of(reservoir.uv), receiver.position);
      // With shadowed targets the sample is known to be visible: an occluded one has W = 0.
      if (has_shadowed_target(ESTIMATOR) || !occluded(receiver.origin, s.point, false)) {
        const vec3 direct = reflected(receiver, s) * reservoir.W;
        add_direct(layers, reservoir.light, light, direct);
        radiance += direct;
      }
    }
  } else {
    radiance = layers.emitted = seen_sky(pixel);
  }
  FRAME.radiance.at[index] = single_frame(radiance);
  add_layers(index, layers, FRAME.reset != 0u);
}
