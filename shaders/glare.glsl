// Light that the eye scatters around what is bright: a pyramid of pictures, each of half the side
// of the one below. A level spreads a pixel's light like a Gaussian twice as wide as the level
// below does; the point spread function of the eye is a sum of such Gaussians
// (runtime/render/glare.h).

// Returns a pixel of a level, cd/m^2 per channel; level 0 is the picture. No light comes from
// outside the picture.
vec3 level_at(uint level, ivec2 at) {
  const ivec2 size = ivec2(FRAME.glare.size[level]);
  if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, size))) return vec3(0.0);
  const uint index = uint(at.y * size.x + at.x);
  if (level == 0u) return mean_of(FRAME.accumulation.at[index]);
  return FRAME.glare.levels.at[FRAME.glare.first[level] + index];
}

// Returns level `level` at a pixel of the level below: pixels of a fine level lie on those of the
// coarse one or half-way between, and the filter is (1 4 6 4 1) / 8.
vec3 spread_from(uint level, ivec2 fine) {
  const ivec2 coarse = fine / 2, odd = fine & 1;
  const vec3 on = vec3(1.0, 6.0, 1.0) / 8.0, between = vec3(0.0, 0.5, 0.5);
  const vec3 across = odd.x == 0 ? on : between, down = odd.y == 0 ? on : between;
  vec3 sum = vec3(0.0);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x)
      sum += across[x] * down[y] * level_at(level, coarse + ivec2(x - 1, y - 1));
  return sum;
}
