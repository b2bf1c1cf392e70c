#version 460
#extension GL_GOOGLE_include_directive : require
#define WORKGROUP_IS_A_ROW
// The irradiance cache, third step. Round 0 (push.first) starts new cells with what larger or
// smaller cells know of the same place; each round after it adds one path to the cells that still
// want one. After shading, UNCACHED_ROUND adds a path to each pixel whose indirect light the cache
// does not hold: where all places for a cell are taken, and in water films. These pixels are few,
// and in shading itself a CPU driver would work through their branch for all.
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
#include "shaders/accumulation.glsl"
#include "shaders/layers.glsl"

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

// A path from a cell or from a pixel, and what it needs to begin.
struct PathStart {
  Receiver receiver;
  float film_share;  // the probability that it begins in the water film
  float film_alpha;  // of water films elsewhere
  float choice;
  vec2 u;
};

// Starts the path of a cell, which brings illuminance in lux per channel: the cell keeps the light
// that arrives, whatever the surface reflects of it. A surface that reflects all of it diffusely
// shows 1 / pi of its illuminance.
PathStart start_at_cell(uint key, Surface surface) {
  PathStart start;
  start.receiver = receiver_of(surface);
  start.receiver.reflectance = vec3(1.0 / PI);
  start.receiver.wetness = 0.0;
  start.film_share = 0.0;
  start.film_alpha = CACHE_FILM_ALPHA;
  start.choice = 0.0;
  random_state = pcg4d(uvec4(key, FRAME.frame, push.first, FRAME.seed * 16u + STREAM_INDIRECT)).w;
  // Directions are stratified over the samples of a cell.
  const uvec4 first = pcg4d(uvec4(key, 0u, 0u, FRAME.seed * 16u + STREAM_INDIRECT));
  start.u = r2_point(first.xy, FRAME.frame * FRAME.cell_paths + push.first);
  return start;
}

// Starts the path of a pixel, which brings cd/m^2 per channel.
PathStart start_at_pixel(uvec2 pixel, Surface surface, bool only_film) {
  PathStart start;
  start.receiver = receiver_of(surface);
  start.film_share = film_share_of(start.receiver);
  if (only_film) {
    start.receiver.reflectance = vec3(0.0);
    start.film_share = 1.0;
  }
  start.film_alpha = WET_ALPHA;
  seed_random(pixel, STREAM_INDIRECT);
  start.choice = random_float();
  start.u = vec2(random_float(), random_float());
  return start;
}

void add_to_cell(uint index, IrradianceCell cell, vec3 lux) {
  const float samples = min(cell.samples + 1.0, FRAME.max_cell_samples);
  FRAME.cells.at[index].irradiance = cell.irradiance + (lux - cell.irradiance) / samples;
  FRAME.cells.at[index].samples = samples;
}

void add_to_pixel(uint index, Surface surface, vec3 light) {
  LightLayers layers = NO_LAYERS;
  layers.indirect = light * transmittance(surface.position, FRAME.camera.position);
  FRAME.radiance.at[index] = single_frame(FRAME.radiance.at[index].sum + layers.indirect);
  add_layers(index, layers, false);
}

// Does an entry of the list of cells, or of pixels. Both follow paths at one place: a driver takes
// seconds to compile it.
void work_at(uint entry, bool is_pixel) {
  const uint index = is_pixel ? entry & ~UNCACHED_FILM : entry;
  IrradianceCell cell;
  Surface surface;
  PathStart start;
  if (is_pixel) {
    const uint width = FRAME.size.x;
    surface = FRAME.surfaces.at[index];
    start = start_at_pixel(uvec2(index % width, index / width), surface, entry != index);
  } else {
    cell = FRAME.cells.at[index];
    const bool is_new = cell.made == FRAME.frame + 1u;
    if (push.first == 0u ? !is_new : push.first > wanted_paths(cell)) return;
    surface = FRAME.surfaces.at[pixel_of_code(cell.owner)];
    if (push.first == 0u) {
      start_cell(index, surface);
      return;
    }
    start = start_at_cell(cell.key, surface);
  }
  const vec3 light = reflected_bounces(start.receiver, start.film_share, start.choice, start.u,
                                       start.film_alpha, FRAME.bounces);
  if (is_pixel)
    add_to_pixel(index, surface, light);
  else
    add_to_cell(index, cell, PI * light);
}

// Each of push.count invocations takes every push.count-th entry.
void main() {
  const bool is_pixel = push.first == UNCACHED_ROUND;
  const uint listed = is_pixel ? FRAME.uncached.at[0] : FRAME.seen_cells.at[0];
  for (uint at = INVOCATION.x; at < listed; at += push.count)
    work_at(is_pixel ? FRAME.uncached.at[1u + at] : FRAME.seen_cells.at[1u + at], is_pixel);
}
