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

// Where on the ray the triangle's plane lies. The traversal's own t, from barycentric sums, is off by about a millionth of the
// triangle's size: on ground of kilometres more than offset_origin makes up for.
float plane_t(Hit hit, vec3 origin, vec3 direction) {
  const vec3 a = SCENE.triangles.at[hit.triangle * 3u].xyz;
  const vec3 b = SCENE.triangles.at[hit.triangle * 3u + 1u].xyz;
  const vec3 c = SCENE.triangles.at[hit.triangle * 3u + 2u].xyz;
  const Instance instance = SCENE.instances.at[hit.instance];
  const vec3 n = cross(b - a, c - a);
  const vec3 o = vec3(dot(instance.to_object[0], vec4(origin, 1.0)), dot(instance.to_object[1], vec4(origin, 1.0)),
                      dot(instance.to_object[2], vec4(origin, 1.0)));
  const vec3 d = vec3(dot(instance.to_object[0].xyz, direction), dot(instance.to_object[1].xyz, direction),
                      dot(instance.to_object[2].xyz, direction));
  const float along = dot(n, d);
  const float t = along != 0.0 ? dot(n, a - o) / along : hit.t;
  return t > 0.0 && finite(t) ? t : hit.t;
}

uint material_of(Hit hit) {
  const vec4 a = SCENE.triangles.at[hit.triangle * 3u];
  return floatBitsToUint(a.w);
}
