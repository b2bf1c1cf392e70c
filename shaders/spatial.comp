#version 460
#extension GL_GOOGLE_include_directive : require
// Spatial reuse for weights that are not pairwise: combines the pixel's reservoir with those of
// some similar pixels around it. Pairwise weights have pair_targets.comp and pair_reuse.comp.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/reservoir.glsl"
#include "shaders/half_rate.glsl"
#include "shaders/similar.glsl"
#include "shaders/reuse.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!sampled_pixel_of_invocation(pixel, index)) return;
  const Surface surface = FRAME.surfaces.at[index];
  const Reservoir canonical = FRAME.reservoirs.at[index];
  if (surface.depth <= 0.0) {
    FRAME.spatial.at[index] = canonical;
    return;
  }
  seed_random(pixel, STREAM_SPATIAL);

  // A pixel that is not similar is not counted at all: it could not have contributed.
  uint neighbour[MAX_NEIGHBOURS];
  uint found = 0u;
  float others_M = 0.0;
  const uint wanted = lacks_history(canonical.M)
                          ? max(FRAME.neighbours, FRAME.disocclusion_boost)
                          : FRAME.neighbours;
  for (uint i = 0u; i < wanted; ++i) {
    const float radius = FRAME.neighbour_radius * sqrt(random_float());
    const float angle = 2.0 * PI * random_float();
    ivec2 at = ivec2(pixel) + ivec2(round(radius * vec2(cos(angle), sin(angle))));
    if (!is_of_this_frame(uvec2(at))) at.x ^= 1;  // that beside it is
    if (!in_picture(at) || at == ivec2(pixel)) continue;
    const uint at_index = uint(at.y) * FRAME.size.x + uint(at.x);
    if (!similar(surface, FRAME.surfaces.at[at_index])) continue;
    const float M = FRAME.reservoirs.at[at_index].M;
    if (!(M > 0.0)) continue;
    neighbour[found++] = at_index;
    others_M += M;
  }
  if (found == 0u) {
    FRAME.spatial.at[index] = canonical;
    return;
  }

  const Receiver receiver = receiver_of(surface);
  Reuse reuse = begin_reuse(canonical, target(receiver, canonical.light, canonical.uv), others_M);
  for (uint i = 0u; i < found; ++i) {
    const Receiver there = receiver_of(FRAME.surfaces.at[neighbour[i]]);
    add_other(reuse, receiver, canonical, FRAME.reservoirs.at[neighbour[i]], there, i + 1u);
  }
  add_canonical(reuse, canonical);

  Balance balance = begin_balance(reuse);
  if (reuse_weights(ESTIMATOR) == WEIGHTS_BALANCE)
    for (uint i = 0u; i < found; ++i) {
      const Receiver there = receiver_of(FRAME.surfaces.at[neighbour[i]]);
      add_balance(balance, reuse, FRAME.reservoirs.at[neighbour[i]].M, there, i + 1u);
    }
  FRAME.spatial.at[index] = finalize_with_roulette(reuse.builder, normalisation(reuse, balance));
}
