// Half rate: in each frame the pixels of one colour of a checkerboard are sampled and shaded, in
// the next those of the other. fill.comp gives the rest the light of like surfaces beside them. Of
// these, candidates.comp and shade.comp work on the ones that have no such neighbour, emit light or
// show the sky, so that nothing is filled across an edge. docs/estimator.md says what that costs.

// Returns how many pixels of a row have one colour, rounded up.
uint half_width() {
  const uvec2 size = FRAME.size;
  return (size.x + 1u) >> 1u;
}

// Returns whether this frame samples a pixel as a matter of course.
bool is_of_this_frame(uvec2 pixel) {
  return FRAME.half_rate == 0u || ((pixel.x + pixel.y + FRAME.half_rate) & 1u) == 0u;
}

// Returns the x-th pixel of a row that has this frame's colour, or the other one.
uvec2 pixel_of_colour(uint x, uint y, bool other) {
  return uvec2(2u * x + ((y + FRAME.half_rate + uint(other)) & 1u), y);
}

// Sets the pixel of an invocation among those of this frame, which lie side by side so that no
// group is half idle. Returns false beyond the last.
bool sampled_pixel_of_invocation(out uvec2 pixel, out uint index) {
  if (FRAME.half_rate == 0u) return pixel_of_invocation(pixel, index);
  pixel = pixel_of_colour(INVOCATION.x, INVOCATION.y, false);
  const uvec2 size = FRAME.size;
  index = pixel.y * size.x + pixel.x;
  return all(lessThan(pixel, size));
}

// The same among all pixels: on the left those of this frame, on the right the others.
bool any_pixel_of_invocation(out uvec2 pixel, out uint index) {
  if (FRAME.half_rate == 0u) return pixel_of_invocation(pixel, index);
  const uint width = half_width();
  const bool other = INVOCATION.x >= width;
  pixel = pixel_of_colour(other ? INVOCATION.x - width : INVOCATION.x, INVOCATION.y, other);
  const uvec2 size = FRAME.size;
  index = pixel.y * size.x + pixel.x;
  return all(lessThan(pixel, size)) && INVOCATION.x < 2u * width;
}

// Marks a pixel that is to be filled: candidates.comp writes it, and it holds no sample.
const Reservoir FILLED_RESERVOIR = Reservoir(NO_HIT, 1u, 0.0, 0.0);

bool is_filled(Reservoir r) { return r.light == NO_HIT && r.uv == FILLED_RESERVOIR.uv; }

// Returns the index of a pixel in a picture of a size. Places beyond its edges get that of a pixel
// at the edge: Mesa 22.3's CPU driver loads for lanes that have left a loop, too.
uint index_within(ivec2 at, uvec2 size) {
  const uvec2 inside = uvec2(clamp(at, ivec2(0), ivec2(size) - 1));
  return inside.y * size.x + inside.x;
}

const ivec2 BESIDE[4] = ivec2[](ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));

// Returns the reflectance by which filling divides and multiplies, bounded below.
vec3 filling_reflectance(Surface surface) {
  return max(base_colour_of(surface.material), vec3(1e-3));
}

// Returns whether a surface may take the light of the other, which lies beside it: both lie in one
// plane, and either are of one material or reflect diffusely, so that the light of one times the
// ratio of their reflectances is that of the other.
bool may_fill(Surface surface, Surface other) {
  if (surface.depth <= 0.0 || other.depth <= 0.0 || other.light != NO_HIT) return false;
  const vec3 normal = unpack_normal(surface.normal), way = other.position - surface.position;
  if (dot(normal, unpack_normal(other.normal)) < 0.995 ||
      abs(dot(normal, way)) > 0.001 * surface.depth + 0.002 ||
      abs(other.depth - surface.depth) > 0.2 * surface.depth)
    return false;
  if (surface.material == other.material) return true;
  return HAS_GLOSS == 0u && all(equal(emission_of(other.material), vec3(0.0))) &&
         all(greaterThanEqual(base_colour_of(other.material), vec3(0.01)));
}

// Returns whether a pixel that this frame does not sample has to be sampled all the same.
bool must_be_sampled(uvec2 pixel, Surface surface) {
  if (surface.depth <= 0.0 || surface.light != NO_HIT ||
      any(greaterThan(emission_of(surface.material), vec3(0.0))))
    return true;
  for (uint i = 0u; i < 4u; ++i) {
    const ivec2 at = ivec2(pixel) + BESIDE[i];
    const uint there = index_within(at, FRAME.size);
    if (in_picture(at) && may_fill(surface, FRAME.surfaces.at[there])) return false;
  }
  return true;
}
