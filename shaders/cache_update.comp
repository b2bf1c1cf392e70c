#version 460
#extension GL_GOOGLE_include_directive : require
// The irradiance cache, third step. Round 0 (push.first) starts new cells with what larger or
// smaller cells know of the same place; each round after it adds one path to the cells that still
// want one.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/surface_hit.glsl"
#include "shaders/camera.glsl"
#include "shaders/lights.glsl"
#include "shaders/light_sampling.glsl"
#include "shaders/shading.glsl"
#include "shaders/sky.glsl"
#include "shaders/reservoir.glsl"
#include "shaders/resampling.glsl"
#include "shaders/path.glsl"
#include "shaders/irradiance_cache.glsl"

// A new cell gets NEW_CELL_FACTOR times the paths of others in its first frame, and a cell that
// holds those of SETTLED_FRAMES frames a share of them from then on.
const uint SETTLED_FRAMES = 64u;
const uint SETTLED_SHARE = 4u;

// Returns how many paths a cell gets in this frame.
uint wanted_paths(IrradianceCell cell) {
  const uint paths = FRAME.cell_paths;
  if (cell.made == FRAME.frame + 1u) return NEW_CELL_FACTOR * paths;
  return cell.samples < float(SETTLED_FRAMES * paths) ? paths : max(paths / SETTLED_SHARE, 1u);
}

// The light that a new cell takes over from others counts as this many samples at most.
const float MAX_INHERITED = 8.0;

// Adds what another cell knows to a sum over cells, if it is not new itself.
void inherit(CellPlace place, inout vec4 sum) {
  const uint index = find_cell(place);
  if (index == NO_HIT) return;
  const IrradianceCell cell = FRAME.cells.at[index];
  if (cell.made != FRAME.frame + 1u) sum += vec4(cell.irradiance, 1.0) * cell.samples;
}

void start_cell(uint index, Surface surface) {
  CellPlace place = cell_place(surface);
  vec4 sum = vec4(0.0);
  const ivec3 at = place.at;
  ++place.level;
  place.at = at >> 1;
  inherit(place, sum);
  if (sum.w <= 0.0 && place.level >= 2u) {
    place.level -= 2u;
    for (uint i = 0u; i < 8u; ++i) {
      place.at = at * 2 + ivec3(i & 1u, i >> 1u & 1u, i >> 2u);
      inherit(place, sum);
    }
  }
  FRAME.cells.at[index].irradiance = sum.w > 0.0 ? sum.xyz / sum.w : vec3(0.0);
  FRAME.cells.at[index].samples = min(sum.w, MAX_INHERITED);
}

// A wet street throws the mirror image of a lamp on the walls beside it, and hardly a path finds
// it: one that does would stay as a spot. For the cache water films are rougher, so that the same
// light comes from a wider patch of the street (path space regularization; Kaplanyan, Dachsbacher
// 2013).
const float CACHE_FILM_ALPHA = 0.36;

// Returns the illuminance that one path brings to the surface, lux per channel.
vec3 sample_irradiance(uint key, Surface surface) {
  // The cell keeps the light that arrives, whatever the surface reflects of it: a surface that
  // reflects all of it diffusely shows 1 / pi of its illuminance.
  Receiver r = receiver_of(surface);
  r.reflectance = vec3(1.0 / PI);
  r.wetness = 0.0;
  random_state = pcg4d(uvec4(key, FRAME.frame, push.first, FRAME.seed * 16u + STREAM_INDIRECT)).w;
  // Directions are stratified over the samples of a cell.
  const uvec4 start = pcg4d(uvec4(key, 0u, 0u, FRAME.seed * 16u + STREAM_INDIRECT));
  const vec2 u = r2_point(start.xy, FRAME.frame * FRAME.cell_paths + push.first);
  return PI * reflected_bounces(r, 0.0, 0.0, u, CACHE_FILM_ALPHA, FRAME.bounces);
}

void main() {
  uvec2 pixel;
  uint in_list;
  if (!pixel_of_invocation(pixel, in_list) || in_list >= FRAME.seen_cells.at[0]) return;
  const uint index = FRAME.seen_cells.at[1u + in_list];
  const IrradianceCell cell = FRAME.cells.at[index];
  const bool is_new = cell.made == FRAME.frame + 1u;
  if (push.first == 0u ? !is_new : push.first > wanted_paths(cell)) return;
  const Surface surface = FRAME.surfaces.at[pixel_of_code(cell.owner)];
  if (push.first == 0u) {
    start_cell(index, surface);
    return;
  }
  const float samples = min(cell.samples + 1.0, FRAME.max_cell_samples);
  const vec3 sample_lux = sample_irradiance(cell.key, surface);
  FRAME.cells.at[index].irradiance =
      cell.irradiance + (sample_lux - cell.irradiance) / samples;
  FRAME.cells.at[index].samples = samples;
}
