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
#include "shaders/half_rate.glsl"
#include "shaders/resampling.glsl"
#include "shaders/dark_blocks.glsl"

// Lights that are fainter than the strongest candidate by more than this factor are a set of their
// own.
const float STRONG_RANGE = 8.0;
// Strong lights with this share of the candidates' weight are tested for shadow before another is
// chosen.
const float DOMINANT_SHARE = 0.75;

// Returns one of the candidates that the receiver sees, or W = 0. Where lights that outshine all
// others are hidden (a stadium behind a house), one of them would be chosen and dropped nearly
// always. So the candidates are kept in two sets, strong lights and all others, each with a sample
// of its own: if the first is in shadow, its set contributes nothing, and the sample of the others
// stands for theirs. Which candidates belong to which set depends on their targets alone, not on
// the choices, and a shadow test is made of each sample before it counts; so the expected value is
// that of resample_lights() followed by a test.
Reservoir resample_visible_lights(LightSampler light_sampler, Receiver receiver, uint candidates) {
  ReservoirBuilder strongest = EMPTY_BUILDER, others = EMPTY_BUILDER;
  float greatest = 0.0;
  for (uint i = 0u; i < candidates; ++i) {
    const Candidate c = draw_candidate(light_sampler, receiver, i, candidates);
    if (c.target > STRONG_RANGE * greatest) {
      merge(others, strongest);
      strongest = EMPTY_BUILDER;
    }
    greatest = max(greatest, c.target);
    if (c.target * STRONG_RANGE >= greatest)
      update(strongest, c.light, c.uv, c.target, c.weight);
    else
      update(others, c.light, c.uv, c.target, c.weight);
  }
  const float both = strongest.weight_sum + others.weight_sum;
  const bool takes_strongest = random_float() * both < strongest.weight_sum;
  const bool dominated = strongest.weight_sum > DOMINANT_SHARE * both;
  ReservoirBuilder chosen = others;
  if (dominated || takes_strongest) chosen = strongest;
  chosen.weight_sum = both;
  const float factor = play_roulette(chosen, 1.0);
  if (factor == 0.0) return Reservoir(NO_HIT, 0u, float(FRAME.candidates), 0.0);
  bool is_seen = false;
  // A loop, because a second place that traces rays costs more than the rays do.
  for (uint tests = dominated ? 2u : 1u; tests > 0u && chosen.weight_sum > 0.0; --tests) {
    is_seen = sees(receiver, chosen.light, chosen.uv);
    if (tests == 1u || (is_seen && takes_strongest)) break;
    chosen = others;
    if (is_seen) chosen.weight_sum = both;
    is_seen = false;
  }
  chosen.M = float(FRAME.candidates);
  Reservoir reservoir = finalize(chosen, factor);
  if (!is_seen) reservoir.W = 0.0;
  return reservoir;
}

// Stores a pixel's reservoir: where this frame reuses none for the pixel, also as what is shaded.
void store(uint index, bool is_reused, Reservoir reservoir) {
  FRAME.reservoirs.at[index] = reservoir;
  if (!is_reused) FRAME.spatial.at[index] = reservoir;
}

void main() {
  uvec2 pixel;
  uint index;
  if (!any_pixel_of_invocation(pixel, index)) return;
  const Surface surface = FRAME.surfaces.at[index];
  const bool is_reused = is_of_this_frame(pixel);
  if (!is_reused && !must_be_sampled(pixel, surface)) {
    store(index, is_reused, FILLED_RESERVOIR);
    return;
  }
  const LightSampler light_sampler = light_sampler_at(surface.position);
  if (surface.depth <= 0.0 || !any_light_shines(light_sampler)) {
    store(index, is_reused, EMPTY_RESERVOIR);
    return;
  }
  seed_random(pixel, STREAM_CANDIDATES);
  const Receiver receiver = receiver_of(surface);

  if (has_shadowed_target(ESTIMATOR)) {
    store(index, is_reused,
          resample_visible_lights(light_sampler, receiver, candidates_of(pixel)));
    return;
  }
  Reservoir reservoir = resample_lights(light_sampler, receiver, FRAME.candidates);

  // Visibility reuse: a shadowed candidate is not passed on. Its M stays, because the candidates
  // were drawn, and contribute nothing. With shadowed targets W = 0 is exact; otherwise this is the
  // bias that the paper accepts.
  const bool test = drops_shadowed_candidates(ESTIMATOR) || VISIBILITY_REUSE != 0u;
  if (test && reservoir.W > 0.0 && !sees(receiver, reservoir.light, reservoir.uv))
    reservoir.W = 0.0;
  store(index, is_reused, reservoir);
}
