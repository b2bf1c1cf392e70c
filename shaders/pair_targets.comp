#version 460
#extension GL_GOOGLE_include_directive : require
// Spatial reuse in pairs, first half: each pixel's target of its own sample and of its partners'
// samples. With shadowed targets, this is a shadow ray for each partner.
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
  FRAME.pair_targets.at[index] = own.W > 0.0 ? target(receiver, own.light, own.uv) : 0.0;
  for (uint i = 0u; i < FRAME.pairings; ++i) {
    uint partner = find_partner(pixel, i);
    if (partner != NO_HIT) {
      const Reservoir other = FRAME.reservoirs.at[partner];
      if (!(own.M > 0.0 && other.M > 0.0 && uses_pairing(i, own.M, other.M))) partner = NO_HIT;
      else if (other.W > 0.0)
        FRAME.pair_targets.at[pair_target_place(i, index)] =
            estimator_target(receiver, other.light, other.uv);
    }
    FRAME.pair_partners.at[pair_place(i, index)] = partner;
  }
}
