#version 460
#extension GL_GOOGLE_include_directive : require
// The irradiance cache, second step: finds or makes the cell of each pixel's surface, lists the
// cells that this frame sees, and draws the pixel that samples each of them.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/irradiance_cache.glsl"

// Returns the index of a cell, which takes a free place where it is new; NO_HIT where all its
// places are in use.
uint find_or_make_cell(CellPlace place) {
  const uvec2 hash = hash_of(place);
  for (uint i = 0u; i < CELL_PROBES; ++i) {
    const uint index = (hash.x + i) & FRAME.cell_mask;
    const uint before = atomicCompSwap(FRAME.cells.at[index].key, 0u, hash.y);
    if (before == 0u) {
      FRAME.cells.at[index].samples = 0.0;
      FRAME.cells.at[index].made = FRAME.frame + 1u;
    }
    if (before == 0u || before == hash.y) return index;
  }
  return NO_HIT;
}

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const Surface surface = FRAME.surfaces.at[index];
  if (surface.depth <= 0.0) return;
  const uint cell = find_or_make_cell(cell_place(surface));
  if (cell == NO_HIT) return;
  atomicMax(FRAME.cells.at[cell].owner, code_of_pixel(index));
  const uint now = FRAME.frame + 1u;
  if (atomicExchange(FRAME.cells.at[cell].seen, now) != now)
    FRAME.seen_cells.at[1u + atomicAdd(FRAME.seen_cells.at[0], 1u)] = cell;
}
