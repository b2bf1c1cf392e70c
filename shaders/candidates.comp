#version 460
#extension GL_GOOGLE_include_directive : require
// Initial candidates: RIS over a mixture of uniform and flux-proportional light picks (Bitterli et al. 2020, Alg. 3).
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/reservoir.glsl"

uint pick_light(out float pdf) {
  const uint n = SCENE.light_count;
  uint light = random_below(n);
  if (random_float() >= FRAME.uniform_share) {
    const AliasEntry entry = SCENE.alias.at[light];
    if (random_float() >= entry.keep) light = entry.alias;
  }
  // The mixture's density, whichever of the two made the pick.
  pdf = FRAME.uniform_share / float(n) + (1.0 - FRAME.uniform_share) * SCENE.alias.at[light].pdf;
  return light;
}

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const Surface surface = FRAME.surfaces.at[index];
  if (surface.depth <= 0.0 || SCENE.light_count == 0u) {
    FRAME.reservoirs.at[index] = EMPTY_RESERVOIR;
    return;
  }
  seed_random(pixel, STREAM_CANDIDATES);
  const Receiver receiver = receiver_of(surface);

  Selection selection = EMPTY_SELECTION;
  for (uint i = 0u; i < FRAME.candidates; ++i) {
    float pdf;
    const uint light = pick_light(pdf);
    const uint uv = random_uint();
    const float p = target(receiver, light, uv);
    consider(selection, light, uv, p, p / (pdf * float(FRAME.candidates)));
  }
  selection.M = float(FRAME.candidates);
  Reservoir reservoir = finished(selection, 1.0);

  // Visibility reuse: a shadowed candidate is not handed on. Its M stays: it was seen, and contributes nothing.
  // `traced` has shadowed targets, so this is its exact W; for the others it is the bias the paper accepts.
  const bool test = ESTIMATOR == ESTIMATOR_PAPER || ESTIMATOR == ESTIMATOR_TRACED || VISIBILITY_REUSE != 0u;
  if (test && reservoir.W > 0.0 && !sees(receiver, reservoir.light, reservoir.uv)) reservoir.W = 0.0;
  FRAME.reservoirs.at[index] = reservoir;
}
