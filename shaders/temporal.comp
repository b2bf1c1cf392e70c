#version 460
#extension GL_GOOGLE_include_directive : require
// Temporal reuse: combines the pixel's reservoir with the one its surface had in the frame before.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/reservoir.glsl"
#include "shaders/half_rate.glsl"
#include "shaders/similar.glsl"
#include "shaders/history.glsl"
#include "shaders/reuse.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!sampled_pixel_of_invocation(pixel, index)) return;
  const Surface surface = FRAME.surfaces.at[index];
  uint before;
  if (!previous_sample(surface, FRAME.permutation != NO_PERMUTATION, before)) return;

  Reservoir history = sanitized(FRAME.previous_reservoirs.at[before]);
  const Reservoir canonical = FRAME.reservoirs.at[index];
  const Surface surface_before = FRAME.previous_surfaces.at[before];
  // The cap makes old samples fade: without it the history would outvote every new candidate.
  history.M = min(history.M, FRAME.max_history * canonical.M);
  history.M *= history_confidence(surface, surface_before);
  if (history.M <= 0.0) return;

  seed_random(pixel, STREAM_TEMPORAL);
  const Receiver receiver = receiver_of(surface);
  const Receiver there = receiver_of(surface_before, true);
  Reuse reuse =
      begin_reuse(canonical, target(receiver, canonical.light, canonical.uv), history.M);
  add_other(reuse, receiver, canonical, history, there, 1u);
  add_canonical(reuse, canonical);

  Balance balance = begin_balance(reuse);
  if (reuse_weights(ESTIMATOR) == WEIGHTS_BALANCE)
    add_balance(balance, reuse, history.M, there, 1u);
  FRAME.reservoirs.at[index] = finalize_with_roulette(reuse.builder, normalisation(reuse, balance));
}
