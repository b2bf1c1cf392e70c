#version 460
#extension GL_GOOGLE_include_directive : require
// Spatial reuse in pairs, first half: what each pixel reflects of its own sample and of its
// partners' samples. With shadowed targets, this is a shadow ray for each partner.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/reservoir.glsl"
#include "shaders/half_rate.glsl"
#include "shaders/similar.glsl"
#include "shaders/pairing.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!sampled_pixel_of_invocation(pixel, index)) return;
  const Surface surface = FRAME.surfaces.at[index];
  if (surface.depth <= 0.0) {
    for (uint i = 0u; i < FRAME.pairings; ++i)
      FRAME.pair_partners.at[pair_place(i, index)] = NO_HIT;
    return;
  }
  const Receiver receiver = receiver_of(surface);
  const Reservoir own = FRAME.reservoirs.at[index];
  // The pixel's own sample and its partners' take turns in one loop, because a second place that
  // computes targets costs more than the targets do.
  for (uint turn = 0u; turn <= FRAME.pairings; ++turn) {
    const bool is_own = turn == 0u;
    uint place = index;
    Reservoir sampled = own;
    if (!is_own) {
      const uint pairing = turn - 1u;
      uint partner = find_partner(pixel, pairing);
      if (partner != NO_HIT) {
        sampled = FRAME.reservoirs.at[partner];
        const bool both_count = own.M > 0.0 && sampled.M > 0.0;
        if (!both_count || !uses_pairing(pairing, own.M, sampled.M)) partner = NO_HIT;
      }
      FRAME.pair_partners.at[pair_place(pairing, index)] = partner;
      if (partner == NO_HIT) continue;
      place = pair_sample_place(pairing, index);
    }
    if (!(sampled.W > 0.0)) continue;
    // The own sample is visible from here, or its W would be 0.
    const bool shadowed = !is_own && has_shadowed_target(ESTIMATOR);
    FRAME.pair_samples.at[place] =
        reflected_sample(receiver, sampled.light, sampled.uv, shadowed);
  }
}
