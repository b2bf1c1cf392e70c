// Traces rays through the scene, for the closest hit or for occlusion. There are three backends,
// chosen by --trace: our own BVH of quantised four-wide nodes; and the device's
// acceleration structures, either by ray queries (TRACE_QUERY) or in a ray tracing pipeline
// (TRACE_PIPELINE).

#include "shaders/hit_record.glsl"

// trace() returns whether the ray hits anything in (t_min, t_max), where t is in units of
// |direction|. Only instances that share a bit with `mask` count. `hit` is the closest hit; with
// `any`, tracing stops at the first hit found, and `hit` is undefined. `before` traces the geometry
// of the previous frame, whose vehicles stood elsewhere.

// Without traffic, all frames share one geometry.
bool is_other_geometry(bool before) { return HAS_TRAFFIC != 0u && before; }

#if defined(TRACE_QUERY)

bool trace(vec3 origin, vec3 direction, float t_min, float t_max, uint mask, bool any,
           bool before, out Hit hit) {
  hit = Hit(t_max, NO_HIT, NO_HIT);
  const uint flags =
      any ? gl_RayFlagsOpaqueEXT | gl_RayFlagsTerminateOnFirstHitEXT : gl_RayFlagsOpaqueEXT;
  rayQueryEXT query;
  const uvec2 tlas = is_other_geometry(before) ? FRAME.previous_tlas : SCENE.tlas;
  rayQueryInitializeEXT(query, accelerationStructureEXT(tlas), flags, mask, origin, t_min,
                        direction, t_max);
  while (rayQueryProceedEXT(query)) {
  }
  // A miss has no committed intersection to query.
  if (rayQueryGetIntersectionTypeEXT(query, true) == gl_RayQueryCommittedIntersectionNoneEXT)
    return false;
  if (any) return true;
  hit.t = rayQueryGetIntersectionTEXT(query, true);
  hit.instance = rayQueryGetIntersectionInstanceCustomIndexEXT(query, true);
  hit.triangle =
      SCENE.instances.at[hit.instance].root + rayQueryGetIntersectionPrimitiveIndexEXT(query, true);
  return true;
}

#elif defined(TRACE_PIPELINE)

layout(location = 0) rayPayloadEXT Hit ray_hit;  // its triangle counts from the instance's first

bool trace(vec3 origin, vec3 direction, float t_min, float t_max, uint mask, bool any,
           bool before, out Hit hit) {
  ray_hit = Hit(t_max, 0u, 0u);  // trace.rmiss sets the instance to NO_HIT
  // Nothing reads where a shadow ray ended, so trace.rchit need not run.
  const uint flags = any ? gl_RayFlagsOpaqueEXT | gl_RayFlagsTerminateOnFirstHitEXT |
                               gl_RayFlagsSkipClosestHitShaderEXT
                         : gl_RayFlagsOpaqueEXT;
  const uvec2 tlas = is_other_geometry(before) ? FRAME.previous_tlas : SCENE.tlas;
  traceRayEXT(accelerationStructureEXT(tlas), flags, mask, 0, 0, 0, origin, t_min, direction,
              t_max, 0);
  hit = ray_hit;
  if (hit.instance == NO_HIT) return false;
  if (!any) hit.triangle += SCENE.instances.at[hit.instance].root;
  return true;
}

#else

#include "shaders/ray_tests.glsl"

void swap_if_farther(inout float ta, inout uint a, inout float tb, inout uint b) {
  if (tb < ta) {
    const float t = ta; ta = tb; tb = t;
    const uint n = a; a = b; b = n;
  }
}

// The nodes that wait on trace()'s stack. A pass whose rays all look for the closest hit may define
// SKIPS_WHAT_IS_HIDDEN: then a node that the ray enters beyond a hit that was found meanwhile is
// not read. The factor is that of `far` in enter_children(). Shadow rays end at their first hit,
// and would only be slower.
#ifdef SKIPS_WHAT_IS_HIDDEN
#define DEFER(node, t) stack_t[top] = t, stack[top++] = node
#define TAKE_DEFERRED(node, least)         \
  while (node == BVH_EMPTY && top > least) \
    if (stack_t[--top] <= hit.t * 1.000001) node = stack[top]
#else
#define DEFER(node, t) stack[top++] = node
#define TAKE_DEFERRED(node, least) \
  if (node == BVH_EMPTY && top > least) node = stack[--top]
#endif

// Returns whether a ray may meet the ground around the scene in (0, t_end).
bool may_meet_horizon(vec3 origin, vec3 direction, float t_end) {
  const Horizon horizon = SCENE.horizon;
  if (horizon.root == BVH_EMPTY) return false;
  // The part of the ray that is not above all of it.
  const float at_top = (horizon.top - origin.y) / direction.y;
  const float begin = direction.y < 0.0 ? max(at_top, 0.0) : 0.0,
              end = direction.y > 0.0 ? min(at_top, t_end) : t_end;
  if (begin > end || (direction.y == 0.0 && origin.y > horizon.top)) return false;
  const vec2 from = origin.xz + begin * direction.xz, to = origin.xz + end * direction.xz;
  return !(all(greaterThan(min(from, to), horizon.lower)) &&
           all(lessThan(max(from, to), horizon.upper)));
}

bool trace(vec3 origin, vec3 direction, float t_min, float t_max, uint mask, bool any,
           bool before, out Hit hit) {
  hit = Hit(t_max, NO_HIT, NO_HIT);
  uint node = is_other_geometry(before) ? FRAME.previous_root : SCENE.root;
  bool asks_horizon = !any && (mask & MASK_VISIBLE) != 0u;  // which casts no shadow
  if (node == BVH_EMPTY && !asks_horizon) return false;
  uint stack[BVH_STACK];
#ifdef SKIPS_WHAT_IS_HIDDEN
  float stack_t[BVH_STACK];  // at which distances the ray enters them
#endif
  int top = 0;
  int floor_of_level = 0;  // stack height at which an instance, or the scene, is done
  uint instance = STATIC_INSTANCE;
  bool is_inside = false;  // an instance
  Ray ray = make_scene_ray(origin, direction);

  // Inner nodes have a loop of their own, so that lanes in lockstep pay for leaves only once one of
  // them has reached a leaf (Aila, Laine: Understanding the efficiency of ray traversal on GPUs,
  // HPG 2009). BVH_EMPTY counts as a leaf by its top bit, and means that nothing is left in this
  // instance or in the scene.
  while (true) {
    while ((node & BVH_LEAF) == 0u) {
      const uvec4 w0 = SCENE.nodes.at[node * 4u];
      const uvec4 w1 = SCENE.nodes.at[node * 4u + 1u];
      const uvec4 w2 = SCENE.nodes.at[node * 4u + 2u];
      const uvec4 w3 = SCENE.nodes.at[node * 4u + 3u];
      uvec4 child = uvec4(w2.zw, w3.xy);
      vec4 t;
      bvec4 is_entered = enter_children(w0, w1, w2.xy, w3.z, mask, ray, t_min, hit.t, t);
      if (!any) {  // nearest first; shadow rays keep the builder's order, largest first
        t = mix(vec4(1e30), t, is_entered);
        swap_if_farther(t.x, child.x, t.y, child.y);
        swap_if_farther(t.z, child.z, t.w, child.w);
        swap_if_farther(t.x, child.x, t.z, child.z);
        swap_if_farther(t.y, child.y, t.w, child.w);
        swap_if_farther(t.y, child.y, t.z, child.z);
        is_entered = lessThan(t, vec4(1e30));
      }
      // The first child that is entered is next; the others wait, the second on top.
      node = BVH_EMPTY;
      float node_t = 0.0;
      if (is_entered.w) node = child.w, node_t = t.w;
      if (is_entered.z) {
        if (node != BVH_EMPTY) DEFER(node, node_t);
        node = child.z, node_t = t.z;
      }
      if (is_entered.y) {
        if (node != BVH_EMPTY) DEFER(node, node_t);
        node = child.y, node_t = t.y;
      }
      if (is_entered.x) {
        if (node != BVH_EMPTY) DEFER(node, node_t);
        node = child.x;
      }
      TAKE_DEFERRED(node, floor_of_level);
    }
    if (node != BVH_EMPTY) {
      const uint first = node & BVH_LEAF_FIRST_MASK;
      if ((node & BVH_INSTANCE) == 0u) {
        const uint count = ((node & ~BVH_LEAF) >> BVH_LEAF_COUNT_SHIFT) + 1u;
        const vec3 from = is_inside ? ray.origin : origin;
        for (uint i = first; i < first + count; ++i) {
          float t;
          if (intersect_triangle(SCENE.triangles.at[i * 3u].xyz,
                                 SCENE.triangles.at[i * 3u + 1u].xyz,
                                 SCENE.triangles.at[i * 3u + 2u].xyz, from, ray, t_min,
                                 hit.t, t)) {
            hit = Hit(t, i, instance);
            if (any) return true;
          }
        }
      } else if ((SCENE.instances.at[first].mask & mask) != 0u) {
        const vec4 r0 = SCENE.instances.at[first].to_object[0];
        const vec4 r1 = SCENE.instances.at[first].to_object[1];
        const vec4 r2 = SCENE.instances.at[first].to_object[2];
        ray = make_ray(
            vec3(dot(r0.xyz, origin), dot(r1.xyz, origin), dot(r2.xyz, origin)) +
                vec3(r0.w, r1.w, r2.w),
            vec3(dot(r0.xyz, direction), dot(r1.xyz, direction), dot(r2.xyz, direction)));
        is_inside = true;
        instance = first;
        floor_of_level = top;
        node = SCENE.instances.at[first].root;
        continue;
      }
    }
    if (top == floor_of_level && is_inside) {
      is_inside = false;
      instance = STATIC_INSTANCE;
      floor_of_level = 0;
      ray = make_scene_ray(origin, direction);
    }
    node = BVH_EMPTY;
    if (top == 0) {
      // The horizon is last: most rays have met something by then, within the rectangle.
      if (!asks_horizon || !may_meet_horizon(origin, direction, hit.t)) break;
      asks_horizon = false;
      node = SCENE.horizon.root;
      continue;
    }
    TAKE_DEFERRED(node, floor_of_level);
  }
  return hit.triangle != NO_HIT;
}

#endif

bool closest_hit(vec3 origin, vec3 direction, uint mask, out Hit hit) {
  return trace(origin, direction, 0.0, 1e30, mask, false, false, hit);
}

// Returns whether light goes from a point that is clear of its own surface to another such point.
bool unblocked(vec3 from, vec3 to) {
  Hit hit;
  return !trace(from, to - from, 0.0, 1.0, MASK_SHADOW, true, false, hit);
}

// Returns whether anything between a point clear of its own surface (clearance_of) and a point
// of a light casts a shadow, in this frame or in the one before. The margin at the far end spares
// the surface that the light is mounted on: 1e-5 of the way, at most a millimetre and the rounding
// error of the light's coordinates.
bool occluded(vec3 from, vec3 to, bool before) {
  if (COUNT_RAYS != 0u) atomicAdd(FRAME.ray_count.at[0], 1u);
  Hit hit;
  const vec3 way = to - from, size = max(abs(from), abs(to));
  const float margin = 1.0e-3 + 1.0e-6 * max(size.x, max(size.y, size.z));
  const float t_max = 1.0 - min(1.0e-5, margin / max(length(way), margin));
  return trace(from, way, 0.0, t_max, MASK_SHADOW, true, before, hit);
}

// Returns whether a ray from a point clear of its own surface reaches the sky.
bool escapes(vec3 from, vec3 direction) {
  Hit hit;
  return !trace(from, direction, 0.0, 1e30, MASK_SHADOW, true, false, hit);
}
