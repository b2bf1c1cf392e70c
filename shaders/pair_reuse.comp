#version 460
#extension GL_GOOGLE_include_directive : require
// Spatial reuse in pairs, second half: combines the pixel's reservoir with its partners', by the
// targets that pair_targets.comp left on both sides of each pair.
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
#include "shaders/reuse.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!sampled_pixel_of_invocation(pixel, index)) return;
  const Reservoir canonical = FRAME.reservoirs.at[index];
  // Partners first, because the pairwise weights need the sum of their M. A pixel that is not
  // similar is not counted at all: it could not have contributed.
  uint partners[MAX_NEIGHBOURS];
  uint pairings[MAX_NEIGHBOURS];
  uint found = 0u;
  float others_M = 0.0;
  for (uint i = 0u; i < FRAME.pairings; ++i) {
    const uint partner = FRAME.pair_partners.at[pair_place(i, index)];
    if (partner == NO_HIT) continue;
    // A pair counts on both sides or on none, even if rounding made the sides see it differently.
    if (FRAME.pair_partners.at[pair_place(i, partner)] != index) continue;
    others_M += FRAME.reservoirs.at[partner].M;
    partners[found] = partner;
    pairings[found++] = i;
  }
  if (found == 0u) {
    FRAME.spatial.at[index] = canonical;
    return;
  }

  seed_random(pixel, STREAM_SPATIAL);
  Reuse reuse = begin_reuse(canonical, FRAME.pair_targets.at[index], others_M);
  for (uint i = 0u; i < found; ++i) {
    const Reservoir other = FRAME.reservoirs.at[partners[i]];
    PairTargets p = PairTargets(0.0, 0.0, 0.0);  // where a reservoir is empty, none was written
    if (other.W > 0.0) {
      p.other_here = FRAME.pair_targets.at[pair_target_place(pairings[i], index)];
      p.other_there = FRAME.pair_targets.at[partners[i]];
    }
    if (canonical.W > 0.0)
      p.canonical_there = FRAME.pair_targets.at[pair_target_place(pairings[i], partners[i])];
    add_pair(reuse, other, p, i + 1u);
  }
  add_canonical(reuse, canonical);
  FRAME.spatial.at[index] = finalize_with_roulette(reuse.builder, 1.0);
}
