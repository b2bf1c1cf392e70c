#version 460
#extension GL_GOOGLE_include_directive : require
// Vehicles, step 5 of 5, one dispatch per level (push.first, from 1), one invocation per node:
// every four neighbours in the order become a node of the next level, both for rays (BvhNode) and
// for sampling lights (LightNode). Neighbours on a Morton curve are neighbours on the map, so the
// hierarchy is a fair one without a search (Lauterbach et al.: Fast BVH Construction on GPUs,
// 2009). The last dispatch joins the top node and the static scene under the scene's root.
#define WORKGROUP_IS_A_ROW
#include "shaders/common.glsl"

#define TRAFFIC SCENE.traffic

struct Children {
  vec3 lower[4], upper[4];
  uint child[4];  // as in BvhNode
};

// Returns the node with its children's boxes in 8 bits about its corner, rounded outwards, as
// runtime/scene/bvh_node.cpp does.
BvhNode quantised(Children c, vec3 lower, vec3 upper) {
  BvhNode node;
  node.exponents = 0u;
  node.masks = node.pad = 0u;
  for (uint i = 0u; i < 4u; ++i) {
    node.child[i] = c.child[i];
    if (c.child[i] != BVH_EMPTY) node.masks |= 0xFFu << (8u * i);
  }
  for (uint axis = 0u; axis < 3u; ++axis) {
    int exponent =
        clamp(int(ceil(log2(max((upper[axis] - lower[axis]) / 254.0, 1e-20)))), -100, 120);
    const float per_m = uintBitsToFloat(uint(127 - exponent) << 23u);
    node.exponents |= uint(exponent + 127) << (8u * axis);
    node.lower[axis] = node.upper[axis] = 0u;
    const float step_m = uintBitsToFloat(uint(127 + exponent) << 23u);
    node.origin[axis] = lower[axis] - 2.0 * BVH_MARGIN * step_m;
    for (uint i = 0u; i < 4u; ++i) {
      if (c.child[i] == BVH_EMPTY) continue;
      const float low = (c.lower[i][axis] - node.origin[axis]) * per_m - BVH_MARGIN,
                  high = (c.upper[i][axis] - node.origin[axis]) * per_m + BVH_MARGIN;
      node.lower[axis] |= uint(max(low, 0.0)) << (8u * i);
      node.upper[axis] |= uint(min(ceil(high), 255.0)) << (8u * i);
    }
  }
  return node;
}

void main() {
  const uint level = push.first;
  const uint place = gl_GlobalInvocationID.x;
  if (level < TRAFFIC.levels) {
    if (place >= TRAFFIC.level_count[level]) return;
    Children c;
    LightNode all = LightNode(vec3(1e30), 0.0, vec3(-1e30), NO_HIT);
    for (uint i = 0u; i < 4u; ++i) {
      const uint below = 4u * place + i;
      c.lower[i] = c.upper[i] = vec3(0.0);
      c.child[i] = BVH_EMPTY;
      if (below >= TRAFFIC.level_count[level - 1u]) continue;
      const LightNode node = FRAME.vehicle_nodes.at[TRAFFIC.level_first[level - 1u] + below];
      if (node.lower.x > node.upper.x) continue;
      c.lower[i] = node.lower;
      c.upper[i] = node.upper;
      c.child[i] = level == 1u ? BVH_LEAF | BVH_INSTANCE | (TRAFFIC.first_instance + node.item)
                               : TRAFFIC.first_bvh_node + TRAFFIC.level_first[level - 1u] -
                                     TRAFFIC.trip_count + below;
      all.lower = min(all.lower, node.lower);
      all.upper = max(all.upper, node.upper);
      all.flux_lm += node.flux_lm;
    }
    const uint at = TRAFFIC.level_first[level] + place;
    FRAME.vehicle_nodes.at[at] = all;
    TRAFFIC.bvh.at[at - TRAFFIC.trip_count] = quantised(c, all.lower, all.upper);
  } else if (place == 0u) {
    const uint vehicle_root = TRAFFIC.level_first[TRAFFIC.levels - 1u];
    const LightNode all_vehicles = FRAME.vehicle_nodes.at[vehicle_root];
    Children c;
    for (uint i = 0u; i < 4u; ++i) {
      c.lower[i] = c.upper[i] = vec3(0.0);
      c.child[i] = BVH_EMPTY;
    }
    vec3 lower = vec3(1e30), upper = vec3(-1e30);
    if (TRAFFIC.static_root != BVH_EMPTY) {
      c.lower[0] = lower = TRAFFIC.lower;
      c.upper[0] = upper = TRAFFIC.upper;
      c.child[0] = TRAFFIC.static_root;
    }
    if (all_vehicles.lower.x <= all_vehicles.upper.x) {
      c.lower[1] = all_vehicles.lower;
      c.upper[1] = all_vehicles.upper;
      c.child[1] = TRAFFIC.first_bvh_node + vehicle_root - TRAFFIC.trip_count;
      lower = min(lower, all_vehicles.lower);
      upper = max(upper, all_vehicles.upper);
    }
    TRAFFIC.bvh.at[vehicle_root - TRAFFIC.trip_count + 1u] = quantised(c, lower, upper);
  }
}
