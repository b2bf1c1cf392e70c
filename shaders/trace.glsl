// Traces rays through the scene, for the closest hit or for occlusion. There are three backends,
// chosen by --trace: our own two-level BVH of quantised four-wide nodes; and the device's
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

struct Ray {
  vec3 origin;    // in the frame of the boxes
  vec3 inverse;   // 1 / direction in that frame, finite
  // x, y: shear, z: scale (Woop, Benthin, Wald: Watertight Ray/Triangle Intersection, JCGT 2013).
  vec3 shear;
  uint axis;      // of the direction's largest component, in the frame of the triangles
};

vec3 rotate_axis(vec3 v, uint axis) { return axis == 0u ? v.yzx : (axis == 1u ? v.zxy : v); }

vec3 invert(vec3 direction) {
  const vec3 size = abs(direction);
  // A zero component would give 0 * inf = NaN on a box's plane. A large finite slope decides by its
  // sign instead.
  const float least = max(max(size.x, max(size.y, size.z)) * 1e-15, 1e-30);
  return 1.0 / mix(direction, vec3(least), lessThan(size, vec3(least)));
}

Ray make_ray(vec3 origin, vec3 direction) {
  Ray ray;
  ray.origin = origin;
  ray.inverse = invert(direction);
  const vec3 size = abs(direction);
  ray.axis = size.x > size.y ? (size.x > size.z ? 0u : 2u) : (size.y > size.z ? 1u : 2u);
  const vec3 d = rotate_axis(direction, ray.axis);
  ray.shear = vec3(d.xy, 1.0) / d.z;
  return ray;
}

// Returns a vector of model space in the frame of MASK_TURNED's boxes.
vec3 turn_to_boxes(vec3 v) {
  const vec2 along = SCENE.boxes_along;
  return vec3(along.x * v.x + along.y * v.z, v.y, along.x * v.z - along.y * v.x);
}

// Returns 32768 + b for each byte b of a word: b is the second byte of such a float's bits. GPUs put
// a byte in its place faster than they convert it.
vec4 biased_bytes(uint word) {
  return uintBitsToFloat(uvec4(bitfieldInsert(0x47000000u, word, 8, 8),
                               bitfieldInsert(0x47000000u, word >> 8u, 8, 8),
                               bitfieldInsert(0x47000000u, word >> 16u, 8, 8),
                               bitfieldInsert(0x47000000u, word >> 24u, 8, 8)));
}

// Returns the bits of the distances at which a ray meets a plane of each child.
ivec4 plane_distances(uint planes, float offset, float stride) {
  return floatBitsToInt(offset + biased_bytes(planes) * stride);
}

// Returns which of the four children the ray enters, and at which distances. A child counts where
// something below it shares a bit with `mask`. `t_min` >= 0.
bvec4 enter_children(uvec4 w0, uvec4 w1, uvec2 upper_yz, uint masks, uint mask, Ray ray,
                     float t_min, float t_max, out vec4 near) {
  const vec3 origin = uintBitsToFloat(w0.xyz);
  const vec3 size = uintBitsToFloat((uvec3(w0.w, w0.w >> 8u, w0.w >> 16u) & 255u) << 23u);
  // The ray meets plane b of an axis at offset + (32768 + b) * stride. The stride is finite, because
  // no scene is larger than max_coordinate_m (formats/finite.h).
  const vec3 stride = size * ray.inverse;
  const vec3 offset = (origin - ray.origin) * ray.inverse - 32768.0 * stride;
  // Rounding moves a plane by parts of a step, for which the planes have BVH_MARGIN, and by a few
  // times 2^-23 of the distance, which the factor of `far` makes up for. So the test stays
  // conservative (Ize: Robust BVH Ray Traversal, JCGT 2013).
  const uvec3 lower = w1.xyz, upper = uvec3(w1.w, upper_yz);
  const bvec3 is_backwards = lessThan(ray.inverse, vec3(0.0));
  const uvec3 entry = mix(lower, upper, is_backwards), exit = mix(upper, lower, is_backwards);
  // As whole numbers, of which some GPUs find the extreme of three at once. Floats keep their order
  // where one is positive; where `far` is negative, it does not matter which of those it is.
  const ivec4 nearest = max(max(plane_distances(entry.x, offset.x, stride.x),
                                plane_distances(entry.y, offset.y, stride.y)),
                            plane_distances(entry.z, offset.z, stride.z));
  near = intBitsToFloat(max(nearest, ivec4(floatBitsToInt(t_min))));
  const ivec4 farthest = min(min(plane_distances(exit.x, offset.x, stride.x),
                                 plane_distances(exit.y, offset.y, stride.y)),
                             plane_distances(exit.z, offset.z, stride.z));
  const vec4 far = intBitsToFloat(min(farthest, ivec4(floatBitsToInt(t_max)))) * 1.000001;
  const bvec4 hit = lessThanEqual(near, far);
  const uvec4 there = uvec4(masks) & (uvec4(mask) << uvec4(0u, 8u, 16u, 24u));
  return bvec4(hit.x && there.x != 0u, hit.y && there.y != 0u, hit.z && there.z != 0u,
               hit.w && there.w != 0u);
}

// `origin` is the ray's in the frame of the triangle. Watertight: both triangles at a shared edge
// compute the same answer for it.
bool intersect_triangle(vec3 v0, vec3 v1, vec3 v2, vec3 origin, Ray ray, float t_min, float t_max,
                        out float t) {
  const vec3 a = rotate_axis(v0 - origin, ray.axis);
  const vec3 b = rotate_axis(v1 - origin, ray.axis);
  const vec3 c = rotate_axis(v2 - origin, ray.axis);
  precise const vec2 pa = a.xy - ray.shear.xy * a.z;
  precise const vec2 pb = b.xy - ray.shear.xy * b.z;
  precise const vec2 pc = c.xy - ray.shear.xy * c.z;
  precise const float u = pc.x * pb.y - pc.y * pb.x;
  precise const float v = pa.x * pc.y - pa.y * pc.x;
  precise const float w = pb.x * pa.y - pb.y * pa.x;
  t = 0.0;
  if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) return false;
  const float determinant = u + v + w;
  if (determinant == 0.0) return false;
  t = ray.shear.z * (u * a.z + v * b.z + w * c.z) / determinant;
  return t > t_min && t < t_max;
}

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

bool trace(vec3 origin, vec3 direction, float t_min, float t_max, uint mask, bool any,
           bool before, out Hit hit) {
  hit = Hit(t_max, NO_HIT, NO_HIT);
  uint node = is_other_geometry(before) ? FRAME.previous_root : SCENE.root;
  if (node == BVH_EMPTY) return false;
  uint stack[BVH_STACK];
#ifdef SKIPS_WHAT_IS_HIDDEN
  float stack_t[BVH_STACK];  // at which distances the ray enters them
#endif
  int top = 0;
  int floor_of_level = 0;     // stack height at which the current BLAS or TLAS is done
  uint instance = NO_HIT;     // NO_HIT: in the TLAS
  bool is_turned = false;     // the instance is MASK_TURNED
  Ray ray = make_ray(origin, direction);

  // Inner nodes have a loop of their own, so that lanes in lockstep pay for leaves only once one of
  // them has reached a leaf (Aila, Laine: Understanding the efficiency of ray traversal on GPUs,
  // HPG 2009). BVH_EMPTY counts as a leaf by its top bit, and means that nothing is left in this
  // BLAS or TLAS.
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
      uint next = BVH_EMPTY;
      float next_t = 0.0;
      if (is_entered.w) next = child.w, next_t = t.w;
      if (is_entered.z) {
        if (next != BVH_EMPTY) DEFER(next, next_t);
        next = child.z, next_t = t.z;
      }
      if (is_entered.y) {
        if (next != BVH_EMPTY) DEFER(next, next_t);
        next = child.y, next_t = t.y;
      }
      if (is_entered.x) {
        if (next != BVH_EMPTY) DEFER(next, next_t);
        next = child.x;
      }
      TAKE_DEFERRED(next, floor_of_level);
      node = next;
    }
    if (node != BVH_EMPTY) {
      const uint first = node & BVH_LEAF_FIRST_MASK;
      if (instance == NO_HIT) {
        if ((SCENE.instances.at[first].mask & mask) != 0u) {
          const vec4 r0 = SCENE.instances.at[first].to_object[0];
          const vec4 r1 = SCENE.instances.at[first].to_object[1];
          const vec4 r2 = SCENE.instances.at[first].to_object[2];
          ray = make_ray(
              vec3(dot(r0.xyz, origin), dot(r1.xyz, origin), dot(r2.xyz, origin)) +
                  vec3(r0.w, r1.w, r2.w),
              vec3(dot(r0.xyz, direction), dot(r1.xyz, direction), dot(r2.xyz, direction)));
          is_turned = (SCENE.instances.at[first].mask & MASK_TURNED) != 0u;
          if (is_turned) {
            ray.origin = turn_to_boxes(origin);
            ray.inverse = invert(turn_to_boxes(direction));
          }
          instance = first;
          floor_of_level = top;
          node = SCENE.instances.at[first].root;
          continue;
        }
      } else {
        const uint count = ((node & ~BVH_LEAF) >> BVH_LEAF_COUNT_SHIFT) + 1u;
        const vec3 from = is_turned ? origin : ray.origin;
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
      }
    }
    if (top == floor_of_level && instance != NO_HIT) {
      instance = NO_HIT;
      floor_of_level = 0;
      ray = make_ray(origin, direction);
    }
    if (top == 0) break;
    node = BVH_EMPTY;
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
