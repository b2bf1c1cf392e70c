#version 460
#extension GL_GOOGLE_include_directive : require
// Temporal reuse: the pixel's own reservoir with the one its surface had in the frame before.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/reservoir.glsl"
#include "shaders/similar.glsl"
#include "shaders/reuse.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const Surface surface = FRAME.surfaces.at[index];
  uint before;
  if (!previous_pixel(surface, FRAME.permutation != NO_PERMUTATION, before)) return;

  Reservoir history = sanitized(FRAME.previous_reservoirs.at[before]);
  const Reservoir canonical = FRAME.reservoirs.at[index];
  const Surface surface_before = FRAME.previous_surfaces.at[before];
  // Old samples fade: without a cap the history would outvote every new candidate.
  history.M = min(history.M, FRAME.max_history * canonical.M);
  history.M *= confidence(surface, surface_before);
  if (history.M <= 0.0) return;

  seed_random(pixel, STREAM_TEMPORAL);
  const Receiver receiver = receiver_of(surface);
  const Receiver there = receiver_of(surface_before, true);
  Reuse reuse = begin_reuse(receiver, canonical, history.M);
  add_other(reuse, receiver, canonical, history, there, 1u);
  add_canonical(reuse, canonical);

  float normalisation = 1.0;
  if (ESTIMATOR == ESTIMATOR_PAPER) {
    normalisation = 1.0 / reuse.builder.M;
  } else if (ESTIMATOR == ESTIMATOR_BASIC) {
    const ReservoirBuilder s = reuse.builder;
    const float p_there = target(there, s.light, s.uv);
    const float p_source = reuse.chosen == 0u ? s.target : p_there;
    const float sum = canonical.M * s.target + history.M * p_there;
    normalisation = sum > 0.0 ? p_source / sum : 0.0;
  }
  FRAME.reservoirs.at[index] = finalize(reuse.builder, normalisation);
}
