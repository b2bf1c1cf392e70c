// Small geometry: packed normals, frames, and ray origins that clear their own surface.
#include "shaders/octahedral.glsl.h"

// Makes two unit vectors that form a right-handed frame with unit n (Duff et al., JCGT 2017).
void make_frame(vec3 n, out vec3 t, out vec3 b) {
  const float s = n.z >= 0.0 ? 1.0 : -1.0;
  const float a = -1.0 / (s + n.z);
  const float c = n.x * n.y * a;
  t = vec3(1.0 + s * n.x * n.x * a, s * c, -s * n.x);
  b = vec3(c, s + n.y * n.y * a, -n.y);
}

// Returns a unit direction about n from u in [0, 1)^2, its density proportional to the cosine with
// n.
vec3 cosine_direction(vec3 n, vec2 u) {
  vec3 t, b;
  make_frame(n, t, b);
  const float radius = sqrt(u.x), phi = 2.0 * PI * u.y;
  return t * (radius * cos(phi)) + b * (radius * sin(phi)) + n * sqrt(max(1.0 - u.x, 0.0));
}

// Returns the distance off a surface, m, at which a ray that leaves it starts. `p` is the point on
// its triangle, whose rounding error grows with the coordinates: 8 units in the last place, 1 mm at
// 1 km. `extent` is the distance of the triangle's farthest corner from p, m: its plane, and the
// place of a hit on it, are known to a few units in the last place of that. A constant distance
// would be too small far from the origin or too large near it.
float clearance_of(vec3 p, float extent) {
  return 1.0e-6 * max(max(abs(p.x), abs(p.y)), max(abs(p.z), 1.0)) + 1.0e-6 * extent;
}

// Packs a clearance into the upper 10 bits, by a quarter larger at most, so that no ray starts
// nearer to its surface.
uint pack_clearance(float clearance) {
  return ((floatBitsToUint(clearance) << 1u) + 0x3FFFFFu) & 0xFFC00000u;
}

// Returns the clearance of a surface that a pixel shows.
float clearance_of(Surface surface) {
  return uintBitsToFloat((surface.clearance_and_rest & 0xFFC00000u) >> 1u);
}
