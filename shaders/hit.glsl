// What a ray met.

// Unit normal of the triangle in model space, on the side the ray came from.
vec3 facing_normal(Hit hit, vec3 direction) {
  const vec3 a = SCENE.triangles.at[hit.triangle * 3u].xyz;
  const vec3 b = SCENE.triangles.at[hit.triangle * 3u + 1u].xyz;
  const vec3 c = SCENE.triangles.at[hit.triangle * 3u + 2u].xyz;
  const Instance instance = SCENE.instances.at[hit.instance];
  const vec3 n = cross(b - a, c - a);
  // Normals go to model space by the transpose of the inverse, and to_object is the inverse.
  const vec3 normal = instance.to_object[0].xyz * n.x + instance.to_object[1].xyz * n.y + instance.to_object[2].xyz * n.z;
  const float size2 = dot(normal, normal);
  const vec3 unit = size2 > 0.0 ? normal * inversesqrt(size2) : -direction;
  return dot(unit, direction) > 0.0 ? -unit : unit;
}

uint material_of(Hit hit) { return floatBitsToUint(SCENE.triangles.at[hit.triangle * 3u].w); }
