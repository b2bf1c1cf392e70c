// Decides which pixels may share their samples: neighbours, and a pixel with itself one frame
// before.
#include "shaders/projection.glsl"

// Returns whether samples of pixels a and b may be of use to each other; symmetric in a and b. It
// looks at geometry only, so that the choice is independent of the samples.
bool similar(Surface a, Surface b) {
  const float depth = min(a.depth, b.depth);
  if (depth <= 0.0) return false;
  const vec3 n_a = unpack_normal(a.normal), n_b = unpack_normal(b.normal);
  const vec3 way = b.position - a.position;
  return dot(n_a, n_b) > 0.9 &&
         max(abs(dot(n_a, way)), abs(dot(n_b, way))) < 0.02 * depth + 0.01 &&
         abs(a.depth - b.depth) < 0.2 * depth;
}

// Returns the share of the history's M that counts, 0 .. 1, by how far from here the history was
// gathered. A light may be faint at that place and bright at this one; the reuse weights then
// multiply its sample by up to the ratio of the two Ms, about 20. Under a moving camera, distant
// ground, where a pixel covers metres, would show single bright pixels. It looks at geometry only,
// as above.
float history_confidence(Surface now, Surface before) {
  const vec3 d = before.position - now.position;
  return 1.0 / (1.0 + FRAME.history_falloff * dot(d, d));
}

// Finds where a point of a surface was in the frame before, in pixels, and how the camera saw it
// then, so that neither its own motion nor the camera's makes it look like another. Returns false
// where it was not in the picture.
bool previous_place(Surface surface, out Surface expected, out vec2 at) {
  expected = surface;
  at = vec2(0.0);
  if (FRAME.has_history == 0u || surface.depth <= 0.0) return false;
  const Camera camera = FRAME.previous_camera;
  expected.position += surface.motion;
  const vec3 d = expected.position - camera.position;
  expected.depth = length(d);
  vec2 screen;
  if (!screen_of(camera, d, screen)) return false;
  const uvec2 size = FRAME.previous_size;
  at = (screen * 0.5 + 0.5) * vec2(size);
  return all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(size)));  // false for NaN
}

// Finds the pixel that showed this point of this surface in the frame before; returns false where
// there was none.
bool previous_pixel(Surface surface, out uint index) {
  index = 0u;
  Surface expected;
  vec2 at;
  if (!previous_place(surface, expected, at)) return false;
  const uvec2 there = uvec2(at);
  index = there.y * FRAME.previous_size.x + there.x;
  return similar(expected, FRAME.previous_surfaces.at[index]);
}
