#version 460
#extension GL_GOOGLE_include_directive : require
// Initial candidates: resampled importance sampling (RIS) over sampled lights (after Bitterli et
// al. 2020, Alg. 3).
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/light_sampling.glsl"
#include "shaders/shading.glsl"
#include "shaders/reservoir.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const Surface surface = FRAME.surfaces.at[index];
  const LightSampler light_sampler = light_sampler_at(surface.position);
  if (surface.depth <= 0.0 ||
      (SCENE.near_grid.shape.width == 0u && light_sampler.vehicle_share <= 0.0)) {
    FRAME.reservoirs.at[index] = EMPTY_RESERVOIR;
    return;
  }
  seed_random(pixel, STREAM_CANDIDATES);
  const Receiver receiver = receiver_of(surface);

  ReservoirBuilder builder = EMPTY_BUILDER;
  for (uint i = 0u; i < FRAME.candidates; ++i) {
    const float technique = min((float(i) + random_float()) / float(FRAME.candidates), BELOW_ONE);
    const SampledLight chosen = sample_light(light_sampler, surface.position, technique);
    const uint uv = random_uint();
    if (!(chosen.pdf > 0.0)) continue;
    const float p = target_of(receiver, chosen.light, uv);
    update(builder, chosen.index, uv, p, p / (chosen.pdf * float(FRAME.candidates)));
  }
  builder.M = float(FRAME.candidates);
  Reservoir reservoir = finalize(builder, 1.0);

  // Visibility reuse: a shadowed candidate is not passed on. Its M stays, because the candidates
  // were drawn, and contribute nothing. With shadowed targets W = 0 is exact; otherwise this is the
  // bias that the paper accepts.
  const bool test = drops_shadowed_candidates(ESTIMATOR) || VISIBILITY_REUSE != 0u;
  if (test && reservoir.W > 0.0 && !sees(receiver, reservoir.light, reservoir.uv))
    reservoir.W = 0.0;
  FRAME.reservoirs.at[index] = reservoir;
}
