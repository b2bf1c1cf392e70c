#version 460
#extension GL_GOOGLE_include_directive : require
// Spatial reuse: the pixel's reservoir with those of some similar pixels around it.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/reservoir.glsl"
#include "shaders/similar.glsl"
#include "shaders/reuse.glsl"

const uint MAX_NEIGHBOURS = 32u;

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const Surface surface = FRAME.surfaces.at[index];
  const Reservoir canonical = FRAME.reservoirs.at[index];
  if (surface.depth <= 0.0) {
    FRAME.spatial.at[index] = canonical;
    return;
  }
  seed_random(pixel, STREAM_SPATIAL);

  // Neighbours first, so that the sum of their M is known when the pairwise weights need it. One that is not
  // similar is not counted at all: it could not have contributed.
  uint neighbour[MAX_NEIGHBOURS];
  uint found = 0u;
  float others_M = 0.0;
  // Disocclusion boost (Wyman, Panteleev 2021): what history would have given, more neighbours give.
  const bool without_history = FRAME.max_history > 0.0 && canonical.M <= float(FRAME.candidates);
  const uint wanted = min(without_history ? max(FRAME.neighbours, FRAME.disocclusion_boost) : FRAME.neighbours, MAX_NEIGHBOURS);
  for (uint i = 0u; i < wanted; ++i) {
    const float radius = FRAME.neighbour_radius * sqrt(random_float());
    const float angle = 2.0 * PI * random_float();
    const ivec2 at = ivec2(pixel) + ivec2(round(radius * vec2(cos(angle), sin(angle))));
    if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(FRAME.size))) || at == ivec2(pixel)) continue;
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
  Reuse reuse = begin_reuse(receiver, canonical, others_M);
  for (uint i = 0u; i < found; ++i) {
    const Receiver there = receiver_of(FRAME.surfaces.at[neighbour[i]]);
    add_other(reuse, receiver, canonical, FRAME.reservoirs.at[neighbour[i]], there, i + 1u);
  }
  add_canonical(reuse, canonical);

  float normalisation = 1.0;
  if (ESTIMATOR == ESTIMATOR_PAPER) {
    normalisation = 1.0 / reuse.builder.M;
  } else if (ESTIMATOR == ESTIMATOR_BASIC) {
    const ReservoirBuilder s = reuse.builder;
    float p_source = s.target;
    float sum = canonical.M * s.target;
    for (uint i = 0u; i < found; ++i) {
      const float p = target(receiver_of(FRAME.surfaces.at[neighbour[i]]), s.light, s.uv);
      sum += FRAME.reservoirs.at[neighbour[i]].M * p;
      if (reuse.chosen == i + 1u) p_source = p;
    }
    normalisation = sum > 0.0 ? p_source / sum : 0.0;
  }
  FRAME.spatial.at[index] = finalize(reuse.builder, normalisation);
}
