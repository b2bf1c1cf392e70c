#version 460
#extension GL_GOOGLE_include_directive : require
// Initial candidates: a light of each pixel, resampled from several.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/light_sampling.glsl"
#include "shaders/shading.glsl"
#include "shaders/reservoir.glsl"
#include "shaders/resampling.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const Surface surface = FRAME.surfaces.at[index];
  const LightSampler light_sampler = light_sampler_at(surface.position);
  if (surface.depth <= 0.0 || !any_light_shines(light_sampler)) {
    FRAME.reservoirs.at[index] = EMPTY_RESERVOIR;
    return;
  }
  seed_random(pixel, STREAM_CANDIDATES);
  const Receiver receiver = receiver_of(surface);

  Reservoir reservoir = resample_lights(light_sampler, receiver, FRAME.candidates);

  // Visibility reuse: a shadowed candidate is not passed on. Its M stays, because the candidates
  // were drawn, and contribute nothing. With shadowed targets W = 0 is exact; otherwise this is the
  // bias that the paper accepts.
  const bool test = drops_shadowed_candidates(ESTIMATOR) || VISIBILITY_REUSE != 0u;
  if (test && reservoir.W > 0.0 && !sees(receiver, reservoir.light, reservoir.uv))
    reservoir.W = 0.0;
  FRAME.reservoirs.at[index] = reservoir;
}
