// The tests of our own BVH: a ray against the boxes of a node, and against a triangle.

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

// Returns a ray of the scene, before it enters an instance.
Ray make_scene_ray(vec3 origin, vec3 direction) {
  Ray ray = make_ray(origin, direction);
  ray.origin = turn_to_boxes(origin);
  ray.inverse = invert(turn_to_boxes(direction));
  return ray;
}

// Returns 32768 + b for each byte b of a word: b is the second byte of such a float's bits. GPUs
// put a byte in its place faster than they convert it.
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
  // The ray meets plane b of an axis at offset + (32768 + b) * stride. The stride is finite,
  // because no scene is larger than max_coordinate_m (formats/finite.h).
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
