// The surface at the end of a ray.

struct SurfaceHit {
  vec3 normal;     // unit, model space, on the side the ray came from
  uint material;
  uint feature;    // of the triangle, or NO_HIT
  uint light;      // of the triangle, or NO_HIT
};

// Returns the surface that a ray along `direction` hit.
SurfaceHit surface_at(Hit hit, Instance instance, vec3 direction) {
  const vec4 a = SCENE.triangles.at[hit.triangle * 3u];
  const vec4 b = SCENE.triangles.at[hit.triangle * 3u + 1u];
  const vec4 c = SCENE.triangles.at[hit.triangle * 3u + 2u];
  const vec3 n = cross(b.xyz - a.xyz, c.xyz - a.xyz);
  // A normal goes to model space by the transpose of the inverse; to_object is that inverse.
  const vec3 normal = instance.to_object[0].xyz * n.x + instance.to_object[1].xyz * n.y +
                      instance.to_object[2].xyz * n.z;
  const float size2 = dot(normal, normal);
  const vec3 unit = size2 > 0.0 ? normal * inversesqrt(size2) : -direction;
  return SurfaceHit(dot(unit, direction) > 0.0 ? -unit : unit, floatBitsToUint(a.w),
                    floatBitsToUint(b.w), floatBitsToUint(c.w));
}
