#version 460
#extension GL_GOOGLE_include_directive : require
// Light that the air in front of a pixel's surface scatters towards the eye: one sample of (place
// on the ray, point of a light), resampled from several candidates, and one shadow ray, for one
// pixel of each block. No sample is kept for the next frame: that would make the frames of a mean
// alike, and cost more noise over 64 of them than it saves in one (docs/air.md).
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

// The sample that resampling has chosen so far.
struct AirSample {
  vec3 light;   // scattered to the eye without shadows, divided by its target, cd/m^2 per channel
  vec3 place;   // on the ray, m
  vec3 point;   // of the light
  float weight_sum;
};

// Returns one of FRAME.air.candidates samples of the ray, chosen by its target: the luminance of
// the scattered light without shadows, less where they are likely. A light is sampled for the ray,
// and then a distance for the light.
AirSample resample_air(AirRay ray) {
  AirSample chosen = AirSample(vec3(0.0), vec3(0.0), vec3(0.0), 0.0);
  const uint candidates = FRAME.air.candidates;
  const float share = vehicle_share(SCENE.light_tree.levels > 0u);
  for (uint i = 0u; i < candidates; ++i) {
    const float technique = min((float(i) + random_float()) / float(candidates), BELOW_ONE);
    const float u = random_float();
    const vec2 uv = vec2(random_float(), random_float());
    const SampledLight source = sample_light_in_air(ray, share, technique);
    if (!(source.pdf > 0.0)) continue;
    const AirDistance at = sample_distance(ray, source.light, u);
    if (!(at.density > 0.0)) continue;
    vec3 point;
    const vec3 light = scattered(ray, source.light, uv, at.distance, point);
    const float target = luminance(light) * likely_seen(ray, source.light.position, 0.0);
    const float weight = target / (source.pdf * at.density * float(candidates));
    if (!(weight > 0.0) || !finite(weight)) continue;
    chosen.weight_sum += weight;
    if (random_float() * chosen.weight_sum >= weight) continue;
    chosen.light = light / target;
    chosen.place = ray.origin + ray.direction * at.distance;
    chosen.point = point;
  }
  return chosen;
}

// Returns the pixel of a block whose light this frame samples: each in its turn, in an order that
// is the block's own.
uvec2 pixel_of_block(uvec2 block) {
  const uint side = FRAME.air.block;
  const uint start = pcg4d(uvec4(block, STREAM_AIR_BLOCK, FRAME.seed)).w;
  // At half rate a pixel counts in every second frame, and so has two turns, one after the other.
  const uint frame = FRAME.half_rate == 0u ? FRAME.frame : FRAME.frame >> 1u;
  const uint turn = (start % (side * side) + frame % (side * side)) % (side * side);
  return block * side + uvec2(turn % side, turn / side);
}

void main() {
  // There are as many invocations as pixels. The first of them are the blocks, side by side, so
  // that the others end at once and together.
  const uvec2 pixel = pixel_of_block(INVOCATION.xy);
  if (!all(lessThan(pixel, FRAME.size))) return;
  const uint index = pixel.y * FRAME.size.x + pixel.x;
  seed_random(pixel, STREAM_AIR);
  const AirRay ray =
      air_ray(FRAME.camera.position, camera_direction(pixel), FRAME.surfaces.at[index]);
  const AirSample chosen = resample_air(ray);
  LightLayers layers = NO_LAYERS;
  // Weighted by one over the share of frames that sample the pixel.
  const vec3 light = chosen.light * chosen.weight_sum * float(FRAME.air.block * FRAME.air.block);
  if (chosen.weight_sum > 0.0 && all_finite(light) &&
      !occluded(chosen.place, chosen.point, false))
    layers.air = light;
  FRAME.radiance.at[index].sum += layers.air;
  add_layers(index, layers, false);
}
