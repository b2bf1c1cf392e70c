#version 460
#extension GL_GOOGLE_include_directive : require
// Final shading: f(y) V(y) W of the selected sample, or what pair_reuse.comp has added up of all
// samples, plus what the surface emits by itself.
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
#include "shaders/panes.glsl"
#include "shaders/reservoir.glsl"
#include "shaders/half_rate.glsl"
#include "shaders/resampling.glsl"
#ifdef FOLLOWS_PATHS
#include "shaders/path.glsl"
#endif
#include "shaders/irradiance_cache.glsl"
#include "shaders/accumulation.glsl"
#include "shaders/layers.glsl"

// Returns the light that a surface reflects after a bounce at least, cd/m^2 per channel; of the
// cache what it holds: cache_update.comp adds the rest. Compiled without paths where none is
// followed: drivers take longer for them than for all else.
vec3 reflected_indirect(Surface surface, Receiver receiver, uvec2 pixel, uint index) {
#ifdef FOLLOWS_PATHS
  seed_random(pixel, STREAM_INDIRECT);
  const float choice = random_float();
  const vec2 u = vec2(random_float(), random_float());
  return reflected_bounces(receiver, film_share_of(receiver), choice, u, WET_ALPHA, FRAME.bounces);
#else
  vec3 irradiance;
  const bool cached = cached_irradiance(surface, irradiance);
  // The water film mirrors other things from each side, so no cell holds its light.
  if (!cached || film_share_of(receiver) > 0.0) list_uncached(index, cached);
  return cached ? receiver.reflectance * irradiance : vec3(0.0);
#endif
}

// Returns whether pair_reuse.comp has added up the direct light of a pixel.
bool has_light_of_pairs(uvec2 pixel) {
  return has_shadowed_target(ESTIMATOR) && FRAME.neighbours > 0u && is_of_this_frame(pixel);
}

// Returns the light of the pixel's sample, cd/m^2 per channel.
vec3 reflected_direct(Receiver receiver, uint index, inout LightLayers layers) {
  const Reservoir reservoir = FRAME.spatial.at[index];
  if (!(reservoir.W > 0.0 && reservoir.light < SCENE.light_count)) return vec3(0.0);
  // With shadowed targets the sample is known to be visible: an occluded one has W = 0.
  const ReflectedSample s = reflected_sample(receiver, reservoir.light, reservoir.uv,
                                             !has_shadowed_target(ESTIMATOR));
  const vec3 direct = s.in_clear_air * (s.passed * reservoir.W);
  add_direct(layers, reservoir.light, light_at(reservoir.light), direct);
  return direct;
}

void main() {
  uvec2 pixel;
  uint index;
  if (!any_pixel_of_invocation(pixel, index)) return;
  if (FRAME.half_rate != 0u && is_filled(FRAME.spatial.at[index])) return;
  const Surface surface = FRAME.surfaces.at[index];
  const bool in_pairs = has_light_of_pairs(pixel);
  LightLayers layers = NO_LAYERS;
  vec3 radiance;
  if (surface.depth > 0.0) {
    radiance = layers.emitted = seen_emission(surface);
    const Receiver receiver = receiver_of(surface);
    if (SKY_MODE != SKY_DARK) {
      seed_random(pixel, STREAM_SKY);
      layers.sky = reflected_sky_and_moon(receiver);
      radiance += layers.sky;
    }
    if (INDIRECT != INDIRECT_NONE) {
      layers.indirect = reflected_indirect(surface, receiver, pixel, index);
      radiance += layers.indirect;
    }
    radiance += in_pairs ? FRAME.radiance.at[index].sum : reflected_direct(receiver, index, layers);
    const float passed = transmittance(surface.position, FRAME.camera.position);
    const vec3 airlight = sky_airlight(camera_direction(pixel), passed);
    radiance = radiance * passed + airlight;
    see_through_air(layers, passed, airlight);
  } else {
    radiance = layers.emitted = seen_sky(pixel);
  }
  FRAME.radiance.at[index] = single_frame(radiance);
  add_layers(index, layers, FRAME.reset != 0u && !in_pairs);
}
