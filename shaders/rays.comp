#version 460
#extension GL_GOOGLE_include_directive : require
// Traces a list of rays and does nothing else, so that its time is theirs. Each ray's closest hit,
// or with ANY_HIT whether it meets anything that casts a shadow.
#define WORKGROUP_IS_A_ROW
#ifndef ANY_HIT
#define SKIPS_WHAT_IS_HIDDEN
#endif
#include "shaders/common.glsl"
#include "shaders/trace.glsl"

void main() {
  if (INVOCATION.x >= push.count) return;
  const uint index = push.first + INVOCATION.x;
  const ProbeRay ray = FRAME.probe.rays.at[index];
  Hit hit;
#ifdef ANY_HIT
  const bool is_met = trace(ray.from, ray.way, 0.0, ray.t_max, MASK_SHADOW, true, false, hit);
  FRAME.probe.distances.at[index] = is_met ? 0.0 : -1.0;
#else
  const bool is_met = trace(ray.from, ray.way, 0.0, ray.t_max, MASK_VISIBLE, false, false, hit);
  FRAME.probe.distances.at[index] = is_met ? hit.t : -1.0;
#endif
}
