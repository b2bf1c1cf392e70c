// The irradiance cache: indirect illuminance of surfaces, kept in cells of space from frame to
// frame (after Ward, Rubinstein, Clear: A Ray Tracing Solution for Diffuse Interreflection, 1988;
// in a hash table as by Binder et al.: Massively Parallel Path Space Filtering, 2021). A cell is a
// cube of a size that grows with its distance from the camera, for the surfaces that face one of
// six ways. What it holds is the mean over the surfaces that were seen in it: unbiased there,
// smoothed for each of their points.

// m: no cell is smaller.
const float MIN_CELL_M = 0.125;

// Places in the table at which a cell may lie, from the one that its hash names.
const uint CELL_PROBES = 8u;

struct CellPlace {
  ivec3 at;     // in cells
  uint level;   // log2 of its side in units of MIN_CELL_M
  uint facing;  // 0 .. 5: axis and sign of the largest component of the normal
};

uint facing_of(vec3 normal) {
  const vec3 size = abs(normal);
  if (size.x > max(size.y, size.z)) return normal.x > 0.0 ? 0u : 1u;
  if (size.y > size.z) return normal.y > 0.0 ? 2u : 3u;
  return normal.z > 0.0 ? 4u : 5u;
}

// Returns the level of cells at a distance from the camera, m.
uint cell_level(float depth) {
  return uint(clamp(ceil(log2(FRAME.cell_angle * depth / MIN_CELL_M)), 0.0, 24.0));
}

float cell_side(uint level) { return MIN_CELL_M * float(1u << level); }

CellPlace cell_place(Surface surface) {
  const uint level = cell_level(surface.depth);
  return CellPlace(ivec3(floor(surface.position / cell_side(level))), level,
                   facing_of(unpack_normal(surface.normal)));
}

// Returns the first place in the table, and the key by which the cell is known there. Two cells of
// one key and place would be taken for each other: one pair in 2^32.
uvec2 hash_of(CellPlace place) {
  const uvec4 hash = pcg4d(uvec4(place.at, place.level * 8u + place.facing));
  return uvec2(hash.x, max(hash.y, 1u));
}

// Returns the index of a cell, or NO_HIT where there is none.
uint find_cell(CellPlace place) {
  const uvec2 hash = hash_of(place);
  for (uint i = 0u; i < CELL_PROBES; ++i) {
    const uint index = (hash.x + i) & FRAME.cell_mask;
    const uint key = FRAME.cells.at[index].key;
    if (key == hash.y) return index;
    if (key == 0u) break;
  }
  return NO_HIT;
}

// Returns a pixel's place in the draw of the pixel that samples a cell: in every frame another
// permutation of all words (multiplications by odd numbers and a shift, which can be undone).
uint code_of_pixel(uint index) {
  uint x = (index ^ pcg4d(uvec4(FRAME.frame, 0u, 0u, FRAME.seed)).x) * 0x7feb352du;
  x ^= x >> 16u;
  return x * 0x846ca68bu;
}

// Undoes code_of_pixel.
uint pixel_of_code(uint code) {
  uint x = code * 0x43021123u;
  x ^= x >> 16u;
  return x * 0x1d69e2a5u ^ pcg4d(uvec4(FRAME.frame, 0u, 0u, FRAME.seed)).x;
}

// Returns the indirect illuminance at a surface, lux per channel: between the cells around it, by
// distance to their centres and by the samples that they hold. False where no cell holds any.
bool cached_irradiance(Surface surface, out vec3 irradiance) {
  CellPlace place = cell_place(surface);
  const vec3 at = surface.position / cell_side(place.level) - 0.5;
  const ivec3 corner = ivec3(floor(at));
  const vec3 upper = at - vec3(corner);
  vec3 sum = vec3(0.0);
  float weights = 0.0;
  for (uint i = 0u; i < 8u; ++i) {
    const ivec3 offset = ivec3(i & 1u, i >> 1u & 1u, i >> 2u);
    place.at = corner + offset;
    const uint index = find_cell(place);
    if (index == NO_HIT) continue;
    const IrradianceCell cell = FRAME.cells.at[index];
    if (FRAME.frame + 1u - cell.seen > FRAME.cell_memory) continue;
    const vec3 share = mix(1.0 - upper, upper, vec3(offset));
    const float weight = share.x * share.y * share.z * cell.samples;
    sum += cell.irradiance * weight;
    weights += weight;
  }
  irradiance = weights > 0.0 ? sum / weights : vec3(0.0);
  return weights > 0.0;
}

// A pixel of the list of those whose indirect light the cache does not hold, or not all of it.
const uint UNCACHED_FILM = 0x80000000u;  // only that of the water film is missing

void list_uncached(uint index, bool only_film) {
  FRAME.uncached.at[1u + atomicAdd(FRAME.uncached.at[0], 1u)] =
      index | (only_film ? UNCACHED_FILM : 0u);
}
