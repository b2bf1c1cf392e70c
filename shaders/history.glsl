// Finds a pixel's history: the reservoir that its surface had in the frame before.

// Returns whether a pixel of the frame before shows the expected surface and holds a reservoir, and
// sets its index.
bool is_history(Surface expected, ivec2 at, out uint index) {
  const uvec2 size = FRAME.previous_size;
  index = index_within(at, size);
  if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, ivec2(size)))) return false;
  return !is_filled(FRAME.previous_reservoirs.at[index]) &&
         similar(expected, FRAME.previous_surfaces.at[index]);
}

// Finds the pixel whose reservoir of the frame before serves this surface; returns false where
// there is none. `permuted`: takes a pixel beside it instead, where that shows the same surface.
// Pixels are mirrored within blocks of 4 x 4, and the blocks' corner changes from frame to frame,
// so that pixels do not pass on the same sample for long (Wyman, Panteleev 2021). Where the pixel
// was filled, at half rate, those beside it hold samples: the nearest like one is taken, since the
// weights of reuse suit any pixel that is chosen by geometry alone.
bool previous_sample(Surface surface, bool permuted, out uint index) {
  index = 0u;
  Surface expected;
  vec2 at;
  if (!previous_place(surface, expected, at)) return false;
  const uvec2 size = FRAME.previous_size;
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
  if (!is_filled(FRAME.previous_reservoirs.at[index]))
    return similar(expected, FRAME.previous_surfaces.at[index]);
  const vec2 off = fract(at) - 0.5;
  const ivec2 across = ivec2(off.x < 0.0 ? -1 : 1, 0), along = ivec2(0, off.y < 0.0 ? -1 : 1);
  const ivec2 first = abs(off.x) > abs(off.y) ? across : along, second = across + along - first;
  const ivec2 ways[4] = ivec2[](first, second, -second, -first);
  for (uint i = 0u; i < 4u; ++i)
    if (is_history(expected, ivec2(there) + ways[i], index)) return true;
  return false;
}
