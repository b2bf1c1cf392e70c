// Which pixels may share what they know: neighbours, and a pixel and itself a frame ago.

// May this neighbour's sample be of use here? Geometry only, so the choice is independent of the samples.
bool similar(Surface a, Surface b) {
  if (b.depth <= 0.0 || a.depth <= 0.0) return false;
  const vec3 n = unpack_normal(a.normal);
  return dot(n, unpack_normal(b.normal)) > 0.9 && abs(dot(n, b.position - a.position)) < 0.02 * a.depth + 0.01 &&
         abs(a.depth - b.depth) < 0.2 * a.depth;
}

// How much of the history's M counts where it was gathered at another place, 0 .. 1. Where that place had little of a light
// and this one has much, the weights hand the sample on with up to the ratio of the two Ms, some 20: from a camera that
// moves, far ground, metres a pixel, then shows bright single pixels. Geometry only, as above.
float confidence(Surface now, Surface before) {
  const vec3 d = before.position - now.position;
  return 1.0 / (1.0 + FRAME.history_falloff * dot(d, d));
}

// The pixel, by index, that showed this very place of this surface in the frame before; false where there was none.
// `permuted`: one beside it where that shows the same surface, by blocks of 4 x 4 pixels that are turned round, another
// division into blocks in every frame. Pixels then do not hand the same sample down for long (Wyman, Panteleev 2021).
bool previous_pixel(Surface surface, bool permuted, out uint index) {
  index = 0u;
  if (FRAME.has_history == 0u || surface.depth <= 0.0) return false;
  const Camera camera = FRAME.previous_camera;
  // As the eye saw it then, so that neither its own motion nor the camera's makes it look like another surface.
  Surface expected = surface;
  expected.position += surface.motion;
  const vec3 d = expected.position - camera.position;
  expected.depth = length(d);
  const float z = dot(d, camera.forward);
  if (z <= 0.0) return false;
  const vec2 screen = vec2(dot(d, camera.right) / camera.aspect, -dot(d, camera.up)) / (z * camera.tan_half_height);
  const vec2 at = (screen * 0.5 + 0.5) * vec2(FRAME.size);
  if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, vec2(FRAME.size)))) return false;
  uvec2 there = uvec2(at);
  if (permuted) {
    const uvec2 corner = uvec2(FRAME.permutation & 3u, FRAME.permutation >> 2u & 3u);
    const uvec2 turned = ((there + corner) ^ 3u) - corner;  // beyond the picture below 0 as above
    if (all(lessThan(turned, FRAME.size)) &&
        similar(expected, FRAME.previous_surfaces.at[turned.y * FRAME.size.x + turned.x]))
      there = turned;
  }
  index = there.y * FRAME.size.x + there.x;
  return similar(expected, FRAME.previous_surfaces.at[index]);
}
