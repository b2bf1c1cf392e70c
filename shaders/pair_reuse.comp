#version 460
#extension GL_GOOGLE_include_directive : require
// Spatial reuse in pairs, second half: combines the pixel's reservoir with its partners', by what
// pair_targets.comp left on both sides of each pair. With shadowed targets it adds up the light of
// all these samples for shade.comp: the one that is kept has the luminance of all, but its own
// colour.
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
#include "shaders/accumulation.glsl"
#include "shaders/layers.glsl"

// The light of the samples that a pixel combines.
struct Direct {
  vec3 sum;
  LightLayers layers;
};

// Adds the light of a reservoir's sample, by its weight.
void add_light(inout Direct direct, Reservoir from, ReflectedSample s, float weight) {
  if (!has_shadowed_target(ESTIMATOR) || !(weight > 0.0 && from.light < SCENE.light_count)) return;
  const vec3 light = s.in_clear_air * (s.passed * weight);
  direct.sum += light;
  if (HAS_LAYERS != 0u) add_direct(direct.layers, from.light, light_at(from.light), light);
}

void store_light(uint index, Direct direct) {
  if (!has_shadowed_target(ESTIMATOR)) return;
  FRAME.radiance.at[index] = single_frame(direct.sum);
  if (HAS_LAYERS == 0u) return;
  const vec3 seen = FRAME.surfaces.at[index].position;
  see_through_air(direct.layers, transmittance(seen, FRAME.camera.position), vec3(0.0));
  add_layers(index, direct.layers, FRAME.reset != 0u);
}

// Returns what a pixel reflects of a reservoir's sample; nothing where the reservoir is empty,
// because pair_targets.comp has not written it then.
ReflectedSample reflected_of(Reservoir r, uint place) {
  if (!(r.W > 0.0)) return NOTHING_REFLECTED;
  return FRAME.pair_samples.at[place];
}

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
  const ReflectedSample own = reflected_of(canonical, index);
  Direct direct = Direct(vec3(0.0), NO_LAYERS);
  if (found == 0u) {
    FRAME.spatial.at[index] = canonical;
    add_light(direct, canonical, own, canonical.W);
    store_light(index, direct);
    return;
  }

  seed_random(pixel, STREAM_SPATIAL);
  Reuse reuse = begin_reuse(canonical, target_of(own), others_M);
  for (uint i = 0u; i < found; ++i) {
    const Reservoir other = FRAME.reservoirs.at[partners[i]];
    const ReflectedSample here = reflected_of(other, pair_sample_place(pairings[i], index));
    PairTargets p;
    p.other_here = target_of(here);
    p.other_there = target_of(reflected_of(other, partners[i]));
    p.canonical_there =
        target_of(reflected_of(canonical, pair_sample_place(pairings[i], partners[i])));
    add_light(direct, other, here, add_pair(reuse, other, p, i + 1u));
  }
  add_light(direct, canonical, own, add_canonical(reuse, canonical));
  FRAME.spatial.at[index] = finalize_with_roulette(reuse.builder, 1.0);
  store_light(index, direct);
}
