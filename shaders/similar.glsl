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

// Finds the pixel that showed this point of this surface in the frame before; returns false where
// there was none. `permuted`: takes a pixel beside it instead, where that shows the same surface.
// Pixels are mirrored within blocks of 4 x 4, and the blocks' corner changes from frame to frame,
// so that pixels do not pass on the same sample for long (Wyman, Panteleev 2021).
bool previous_pixel(Surface surface, bool permuted, out uint index) {
  index = 0u;
  if (FRAME.has_history == 0u || surface.depth <= 0.0) return false;
  const Camera camera = FRAME.previous_camera;
  // The surface as the camera saw it then, so that neither its own motion nor the camera's makes it
  // look like another.
  Surface expected = surface;
  expected.position += surface.motion;
  const vec3 d = expected.position - camera.position;
  expected.depth = length(d);
  vec2 screen;
  if (!screen_of(camera, d, screen)) return false;
  const uvec2 size = FRAME.previous_size;
  const vec2 at = (screen * 0.5 + 0.5) * vec2(size);
  if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, vec2(size)))) return false;
  uvec2 there = uvec2(at);
  if (permuted) {
    const uvec2 corner = uvec2(FRAME.permutation & 3u, FRAME.permutation >> 2u & 3u);
    // Wraps below 0, which is outside the picture too.
    const uvec2 turned = ((there + corner) ^ 3u) - corner;
    if (all(lessThan(turned, size)) &&
        similar(expected, FRAME.previous_surfaces.at[turned.y * size.x + turned.x]))
      there = turned;
  }
  index = there.y * size.x + there.x;
  return similar(expected, FRAME.previous_surfaces.at[index]);
}
