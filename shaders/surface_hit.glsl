// The surface at the end of a ray.

struct SurfaceHit {
  vec3 position;   // on the triangle's plane, model space, m
  float clearance; // distance off the surface at which rays that leave it start, m
  vec3 normal;     // unit, model space, on the side the ray came from
  uint material;   // MATERIAL_IS_COLOUR
  uint feature;    // of the triangle, or NO_HIT
  uint light;      // of the triangle, or NO_HIT
};

vec3 to_object_space(Instance instance, vec3 p) {
  return vec3(dot(instance.to_object[0], vec4(p, 1.0)), dot(instance.to_object[1], vec4(p, 1.0)),
              dot(instance.to_object[2], vec4(p, 1.0)));
}

// The spread of rays that are not the camera's: they take the mean of a texture around a place,
// so that it does not matter from where a path comes there.
const float WIDE_SPREAD = 1e6;

// Returns the word of a surface's material (materials.glsl): its number, or the reflectance where a
// texture lies on it, over a footprint of that diameter, m. a, b, c and `local` are in the frame of
// the mesh, n is the cross product of two edges.
uint material_at(uint material, uint triangle, vec3 a, vec3 b, vec3 c, vec3 n, vec3 local,
                 float footprint) {
  if (HAS_TEXTURES == 0u) return material;
  const uint number = SCENE.materials.at[material].texture;
  if (number == 0u || number == PANE) return material;
  const TextureCorners corners = SCENE.texture_corners.at[triangle];
  const float area2 = dot(n, n);
  const float along_b = dot(cross(local - a, c - a), n) / area2,
              along_c = dot(cross(b - a, local - a), n) / area2;
  const vec2 to_b = corners.b - corners.a, to_c = corners.c - corners.a;
  const vec2 place = corners.a + along_b * to_b + along_c * to_c;
  if (!(dot(place, place) < 1e12)) return material;
  const Texture picture = SCENE.textures.at[number - 1u];
  // Texels to a metre, from the areas of the triangle in the picture and in the mesh.
  const float texels2 = abs(to_b.x * to_c.y - to_b.y * to_c.x) * float(picture.width) *
                        float(picture.height) * inversesqrt(area2);
  const float level = 0.5 * log2(max(texels2 * footprint * footprint, 1.0)) + 0.5;
  return pack_colour(texture_colour(picture, place, min(uint(level), picture.levels - 1u)));
}

// Returns the surface that a ray hit. `spread` is the ray's width over its length.
SurfaceHit surface_at(Hit hit, Instance instance, vec3 origin, vec3 direction, float spread) {
  const vec4 a = SCENE.triangles.at[hit.triangle * 3u];
  const vec4 b = SCENE.triangles.at[hit.triangle * 3u + 1u];
  const vec4 c = SCENE.triangles.at[hit.triangle * 3u + 2u];
  const vec3 n = cross(b.xyz - a.xyz, c.xyz - a.xyz);
  // A normal goes to model space by the transpose of the inverse; to_object is that inverse.
  const vec3 normal = instance.to_object[0].xyz * n.x + instance.to_object[1].xyz * n.y +
                      instance.to_object[2].xyz * n.z;
  const float size2 = dot(normal, normal);
  const vec3 unit = size2 > 0.0 ? normal * inversesqrt(size2) : -direction;
  // t has an error that grows with the triangle, and origin + t * direction one that grows with the
  // distance. Both are taken off: the first along the ray, unless it grazes the surface, and then
  // what is left along the normal, which would put the point below the surface.
  vec3 position = origin + direction * hit.t;
  vec3 local = to_object_space(instance, position);
  if (size2 > 0.0) {
    const float slope = dot(normal, direction);
    if (slope * slope > 0.01 * size2 * dot(direction, direction)) {
      position -= direction * (dot(n, local - a.xyz) / slope);
      local = to_object_space(instance, position);
    }
    position -= normal * (dot(n, local - a.xyz) / size2);
    local = to_object_space(instance, position);
  }
  const vec3 from_a = local - a.xyz, from_b = local - b.xyz, from_c = local - c.xyz;
  const float extent2 = max(dot(from_a, from_a), max(dot(from_b, from_b), dot(from_c, from_c)));
  // The instance's scale along the normal: |n| / |to_object^T n|.
  const float scale = size2 > 0.0 ? length(n) * inversesqrt(size2) : 1.0;
  // A surface that is seen at a slant shows more of itself: the mean of both diameters.
  const float footprint = spread * hit.t * inversesqrt(max(abs(dot(unit, direction)), 0.01));
  return SurfaceHit(position, clearance_of(position, sqrt(extent2) * scale),
                    dot(unit, direction) > 0.0 ? -unit : unit,
                    material_at(floatBitsToUint(a.w), hit.triangle, a.xyz, b.xyz, c.xyz, n, local,
                                footprint),
                    floatBitsToUint(b.w), floatBitsToUint(c.w));
}

const Surface NO_SURFACE = Surface(vec3(0.0), 0u, 0.0, 0u, NO_HIT, NO_HIT, vec3(0.0), 0u);

// Returns the first surface along unit `direction` that shares a bit with `mask`, its `motion` 0;
// depth 0 where there is none. `hit` is its triangle and instance. `spread` as surface_at's.
Surface first_surface(vec3 origin, vec3 direction, uint mask, float spread, out Hit hit) {
  Surface surface = NO_SURFACE;
  if (!closest_hit(origin, direction, mask, hit)) return surface;
  const Instance instance = SCENE.instances.at[hit.instance];
  const SurfaceHit seen = surface_at(hit, instance, origin, direction, spread);
  surface.position = seen.position;
  surface.normal = pack_normal(seen.normal);
  surface.clearance_and_rest =
      pack_clearance(seen.clearance) | pack_normal_rest(seen.normal, surface.normal);
  surface.depth = hit.t;
  surface.material = seen.material;
  surface.feature = instance.feature != NO_HIT ? instance.feature : seen.feature;
  if (HAS_TRAFFIC != 0u && (instance.mask & MASK_VEHICLE) != 0u)
    surface.light = seen.light < VEHICLE_LIGHTS ? instance.light + seen.light : NO_HIT;
  else
    surface.light = instance.light != NO_HIT ? instance.light : seen.light;
  return surface;
}
