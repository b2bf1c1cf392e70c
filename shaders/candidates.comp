#version 460
#extension GL_GOOGLE_include_directive : require
// Initial candidates: RIS over a mixture of local, uniform and flux-proportional light picks (after Bitterli et al. 2020,
// Alg. 3).
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/reservoir.glsl"

LightCell cell_of(vec3 position, out vec2 centre) {
  const LightGridShape grid = SCENE.grid;
  const vec2 at = clamp(floor((position.xz - vec2(grid.origin_x, grid.origin_z)) / grid.cell_m), vec2(0.0),
                        vec2(grid.width, grid.depth) - 1.0);
  centre = vec2(grid.origin_x, grid.origin_z) + (at + 0.5) * grid.cell_m;
  return SCENE.cells.at[uint(at.y) * grid.width + uint(at.x)];
}

// Probability that the cell's list gives this light: membership is decided by strength, so no list is searched.
float local_pdf(Light light, LightCell cell, vec2 centre) {
  const vec2 d = light.position.xz - centre;
  const float strength = light.flux_lm / (dot(d, d) + SCENE.grid.softening_m2);
  return strength >= cell.threshold && strength > 0.0 ? strength / cell.strength_sum : 0.0;
}

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const Surface surface = FRAME.surfaces.at[index];
  if (surface.depth <= 0.0 || SCENE.grid.width == 0u) {
    FRAME.reservoirs.at[index] = EMPTY_RESERVOIR;
    return;
  }
  seed_random(pixel, STREAM_CANDIDATES);
  const Receiver receiver = receiver_of(surface);
  vec2 centre;
  const LightCell cell = cell_of(surface.position, centre);
  const float local_share = cell.count > 0u ? FRAME.local_share : 0.0;
  const float uniform_share = FRAME.uniform_share;
  const uint light_count = SCENE.light_count;

  Selection selection = EMPTY_SELECTION;
  for (uint i = 0u; i < FRAME.candidates; ++i) {
    const float technique = random_float();
    uint light;
    if (technique < local_share) {
      const LocalEntry entry = SCENE.local_entries.at[cell.first + random_below(cell.count)];
      light = random_float() < entry.keep ? entry.light : entry.alias_light;
    } else {
      light = random_below(light_count);
      if (technique >= local_share + uniform_share) {
        const AliasEntry entry = SCENE.alias.at[light];
        if (random_float() >= entry.keep) light = entry.alias;
      }
    }
    const uint uv = random_uint();
    const Light sampled = SCENE.lights.at[light];
    // The mixture's density, whichever technique made the pick.
    float pdf = uniform_share / float(light_count);
    if (local_share > 0.0) pdf += local_share * local_pdf(sampled, cell, centre);
    pdf += max(1.0 - local_share - uniform_share, 0.0) * SCENE.alias.at[light].pdf;
    const float p = target_of(receiver, sampled, uv);
    consider(selection, light, uv, p, p / (pdf * float(FRAME.candidates)));
  }
  selection.M = float(FRAME.candidates);
  Reservoir reservoir = finished(selection, 1.0);

  // Visibility reuse: a shadowed candidate is not handed on. Its M stays: it was seen, and contributes nothing.
  // `traced` has shadowed targets, so this is its exact W; for the others it is the bias the paper accepts.
  const bool test = ESTIMATOR == ESTIMATOR_PAPER || ESTIMATOR == ESTIMATOR_TRACED || VISIBILITY_REUSE != 0u;
  if (test && reservoir.W > 0.0 && !sees(receiver, reservoir.light, reservoir.uv)) reservoir.W = 0.0;
  FRAME.reservoirs.at[index] = reservoir;
}
