#version 460
#extension GL_GOOGLE_include_directive : require
// Temporal reuse: combines the pixel's reservoir with the one its surface had in the frame before.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/camera.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/reservoir.glsl"
#include "shaders/half_rate.glsl"
#include "shaders/similar.glsl"
#include "shaders/history.glsl"
#include "shaders/reuse.glsl"

// A long history makes a frame better and the frames of a mean alike. Where a pixel spans more than
// NEAR_SPAN, m, its partners lie under other lamps, and history adds less to a frame than it takes
// from the mean. So from RESTED_FRAMES on it is shorter there, down to FAR_HISTORY.
const uint RESTED_FRAMES = 4u;
const float NEAR_SPAN = 0.15;
const float FAR_HISTORY = 5.0;

// Returns the history's greatest M for a pixel, in multiples of the candidates' M. It depends on
// geometry and on the number of frames alone, as weights may (docs/estimator.md, condition 2).
float longest_history(Surface surface) {
  if (!has_shadowed_target(ESTIMATOR) || FRAME.frames_at_rest < RESTED_FRAMES)
    return FRAME.max_history;
  const float span = surface.depth * pixel_spread();
  return min(FRAME.max_history, max(FAR_HISTORY, FRAME.max_history * NEAR_SPAN / span));
}

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
  history.M = min(history.M, longest_history(surface) * canonical.M);
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
