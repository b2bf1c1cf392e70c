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

// Returns a point off the surface, on the side of its normal. The rounding error of origin + t *
// direction grows with the coordinates and with t, so the offset does too: 32 units in the last
// place, 4 mm at 1 km. A constant offset would be too small far from the origin or too large near
// it.
vec3 offset_origin(vec3 p, vec3 n, float t) {
  const float magnitude = max(max(abs(p.x), abs(p.y)), max(abs(p.z), max(t, 1.0)));
  return p + n * (magnitude * 4.0e-6);
}
