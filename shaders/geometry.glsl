// Small geometry: packed normals, frames, and ray origins that clear their own surface.

vec2 sign_not_zero(vec2 v) { return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0); }

// Octahedral unit vectors (Cigolle et al., JCGT 2014), 2 x 16 bits.
uint pack_normal(vec3 n) {
  n /= abs(n.x) + abs(n.y) + abs(n.z);
  const vec2 p = n.z >= 0.0 ? n.xy : (1.0 - abs(n.yx)) * sign_not_zero(n.xy);
  return packSnorm2x16(p);
}

vec3 unpack_normal(uint packed) {
  const vec2 p = unpackSnorm2x16(packed);
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * sign_not_zero(n.xy);
  return normalize(n);
}

// Two unit vectors that make a right-handed frame with unit n (Duff et al., JCGT 2017).
void make_frame(vec3 n, out vec3 t, out vec3 b) {
  const float s = n.z >= 0.0 ? 1.0 : -1.0;
  const float a = -1.0 / (s + n.z);
  const float c = n.x * n.y * a;
  t = vec3(1.0 + s * n.x * n.x * a, s * c, -s * n.x);
  b = vec3(c, s + n.y * n.y * a, -n.y);
}

// A unit direction about n from u in [0, 1)^2, its density proportional to the cosine with n.
vec3 cosine_direction(vec3 n, vec2 u) {
  vec3 t, b;
  make_frame(n, t, b);
  const float radius = sqrt(u.x), phi = 2.0 * PI * u.y;
  return t * (radius * cos(phi)) + b * (radius * sin(phi)) + n * sqrt(max(1.0 - u.x, 0.0));
}

// A point on the normal's side of its surface. The error of origin + t * direction grows with the coordinates and
// with t, so the step does too: 32 units in the last place, 4 mm at 1 km, where a constant would fail.
vec3 offset_origin(vec3 p, vec3 n, float t) {
  const float magnitude = max(max(abs(p.x), abs(p.y)), max(abs(p.z), max(t, 1.0)));
  return p + n * (magnitude * 4.0e-6);
}
