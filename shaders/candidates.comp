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
#include "shaders/blocks.glsl"

// Lights that are fainter than the strongest candidate by more than this factor are a set of their
// own.
const float STRONG_RANGE = 8.0;
// The chance to test the others where all strong lights of the block were hidden. It falls as the
// cube of the share that were: where a shadow ends within a block, lit pixels pay for it.
const float CHANCE_OF_OTHERS = 0.875;
// Strong lights with DOMINANT_SHARE of the weight are tested before another is chosen, if nothing
// is known of the block. Those with NOTED_SHARE are noted as seen or hidden.
const float DOMINANT_SHARE = 0.75, NOTED_SHARE = 0.5;

// Returns one of the candidates that the receiver sees, or W = 0. Where lights that outshine all
// others are hidden (a stadium behind a house), one of them would be chosen and dropped nearly
// always. So the candidates are kept in two sets, strong lights and all others, each with a sample
// of its own. Which candidates belong to which depends on their targets alone, and a shadow test is
// made of each sample before it counts.
//   One of the two is tested: the strong lights by their share of the weight, but less often where
// the pixel's block saw them hidden. A set's weight is divided by its chance to be tested, so the
// expected value is that of resample_lights() followed by a test, whatever the chance is. It may
// depend on the frame before, M and the weights of reuse may not (docs/estimator.md, condition 2).
//   If nothing is known of the block, both may be tested: where the first is in shadow, its set
// contributes nothing, and the sample of the others stands for theirs.
Reservoir resample_visible_lights(LightSampler light_sampler, Receiver receiver, uint candidates,
                                  uvec2 pixel) {
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
  const float share = others.weight_sum > 0.0 ? strongest.weight_sum / both : 1.0;
  float hidden;
  const bool is_known = find_hidden_share(pixel, hidden);
  float chance = share;
  if (others.weight_sum > 0.0)
    chance = min(chance, 1.0 - CHANCE_OF_OTHERS * hidden * hidden * hidden);
  const bool takes_strongest = random_float() < chance;
  const bool tests_both = !is_known && share > DOMINANT_SHARE;
  ReservoirBuilder chosen = others;
  if (takes_strongest || tests_both) chosen = strongest;
  chosen.weight_sum =
      is_known ? chosen.weight_sum / (takes_strongest ? chance : 1.0 - chance) : both;
  const float factor = play_roulette(chosen, 1.0);
  if (factor == 0.0) return Reservoir(NO_HIT, 0u, float(FRAME.candidates), 0.0);
  bool is_seen = false;
  // A loop, because a second place that traces rays costs more than the rays do.
  for (uint tests = tests_both ? 2u : 1u; tests > 0u && chosen.weight_sum > 0.0; --tests) {
    is_seen = sees(receiver, chosen.light, chosen.uv);
    const bool is_strongest = tests_both ? tests == 2u : takes_strongest;
    if (is_strongest && share > NOTED_SHARE) note_test(pixel, is_seen);
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
          resample_visible_lights(light_sampler, receiver, candidates_of(pixel), pixel));
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
