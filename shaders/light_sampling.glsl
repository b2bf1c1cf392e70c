// Samples lights. Static lights are sampled by a mixture of four techniques: uniformly, in
// proportion to flux, and from the cells of two grids. The near grid lists the lights that are
// strong at a place; the far grid lists those of its neighbourhood, for which the near grid has no
// room. Vehicles' lights are sampled by descending the light BVH over the vehicles (after Conty
// Estevez, Kulla: Importance Sampling of Many Lights, 2018). The two sets are disjoint, so the
// density of a sample is the density of its own set's technique.
//
// The choice of technique is stratified over a pixel's candidates: candidate i of n gets a number
// in [i / n, (i + 1) / n). The mean of the candidates' densities is the mixture's density, so
// weights by the mixture stay exact (the balance heuristic; Veach 1997), and lanes in lockstep
// mostly take the same branch.

// The cell of a grid at a place.
struct GridCell {
  LightCell cell;
  float softening_m2;  // of the grid
  vec2 centre;
  float share;         // of the candidates from static lights
  float density;       // of a light among those candidates, for its strength
};

struct LightSampler {
  GridCell near;
  GridCell far;
  float uniform_share;    // of the candidates from static lights
  float uniform_density;  // of a light among those candidates by this technique
  float power_density;    // the same for a lumen
  float vehicle_share;    // of all candidates
};

struct SampledLight {
  uint index;
  Light light;
  float pdf;  // 0 = no light was found
};

// A scene without lights has none at index 0 either, so this one is read from nowhere.
const SampledLight NO_LIGHT = SampledLight(
    0u, Light(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0.0, 0u, 0u, 0u, 0u), 0.0);

GridCell cell_at(LightGridBuffers grid, vec3 position, float share) {
  GridCell p;
  const LightGridShape shape = grid.shape;
  const vec2 origin = vec2(shape.origin_x, shape.origin_z);
  const vec2 at = clamp(floor((position.xz - origin) / shape.cell_m), vec2(0.0),
                        vec2(shape.width, shape.depth) - 1.0);
  p.softening_m2 = shape.softening_m2;
  p.centre = origin + (at + 0.5) * shape.cell_m;
  p.cell = grid.cells.at[uint(at.y) * shape.width + uint(at.x)];
  p.share = p.cell.count > 0u ? share : 0.0;
  p.density = p.share > 0.0 ? p.share / p.cell.strength_sum : 0.0;
  return p;
}

// Returns the share of all candidates that vehicles' lights get: all or none where only one of the
// two sets shines.
float vehicle_share(bool any_static) {
  if (HAS_TRAFFIC == 0u) return 0.0;
  if (!any_static) return 1.0;
  const LightNode all =
      FRAME.vehicle_nodes.at[SCENE.traffic.level_first[SCENE.traffic.levels - 1u]];
  return all.flux_lm > 0.0 ? FRAME.vehicle_share : 0.0;
}

// Within some 20 m, distance says little of what vehicles contribute: headlamps aim far, and those of
// the nearest vehicle mostly elsewhere.
const float VEHICLE_SOFTENING_M2 = 400.0;

// Returns an estimate of what a node's lights contribute here, whatever their directions. The place
// is in the frame of the nodes' boxes.
float importance(LightNode node, vec3 position) {
  if (node.lower.x > node.upper.x) return 0.0;
  const vec3 d = 0.5 * (node.lower + node.upper) - position;
  const vec3 extent = node.upper - node.lower;
  return node.flux_lm / (max(dot(d, d), 0.25 * dot(extent, extent)) + VEHICLE_SOFTENING_M2);
}

// Returns an estimate of what all vehicles contribute at a place, as the cells' strengths are one
// for static lights: the light BVH is descended to the vehicle that matters most, and what is
// passed by counts as nodes.
float vehicle_strength(vec3 position) {
  float passed_by = 0.0, most = 0.0;
  const vec3 in_boxes = turn_to_boxes(position);
  uint place = 0u;
  for (uint level = SCENE.traffic.levels - 1u; level > 0u; --level) {
    uint chosen = 0u;
    float sum = 0.0;
    most = 0.0;
    for (uint i = 0u; i < 4u; ++i) {
      const uint below = 4u * place + i;
      if (below >= SCENE.traffic.level_count[level - 1u]) break;
      const float strength = importance(
          FRAME.vehicle_nodes.at[SCENE.traffic.level_first[level - 1u] + below], in_boxes);
      sum += strength;
      if (strength <= most) continue;
      most = strength;
      chosen = i;
    }
    passed_by += sum - most;
    place = 4u * place + chosen;
  }
  return passed_by + most;
}

// Returns which part of their share of the candidates vehicles get at a place, from LEAST_PART to
// 1: a walk down their BVH costs several times what a static light costs, and brings little where
// static lights are stronger. The density of a sample has the same part in it, so any part is
// exact.
const float LEAST_PART = 0.2, PART_PER_STRENGTH = 3.0;
float vehicle_part(vec3 position, float static_strength) {
  const float strength = vehicle_strength(position), all = strength + static_strength;
  return all > 0.0 ? clamp(PART_PER_STRENGTH * strength / all, LEAST_PART, 1.0) : 1.0;
}

// Returns the sampler for a receiver's place.
LightSampler light_sampler_at(vec3 position) {
  LightSampler p;
  const bool any_static = SCENE.near_grid.shape.width != 0u;
  p.near.share = p.far.share = 0.0;
  p.uniform_share = FRAME.uniform_share;
  p.uniform_density = p.power_density = 0.0;
  if (any_static) {
    p.near = cell_at(SCENE.near_grid, position, FRAME.near_share);
    p.far = cell_at(SCENE.far_grid, position, FRAME.far_share);
    p.uniform_density = p.uniform_share / float(SCENE.lit_count);
    p.power_density =
        max(1.0 - p.near.share - p.far.share - p.uniform_share, 0.0) / SCENE.lit_flux_lm;
  }
  p.vehicle_share = vehicle_share(any_static);
  // As published, there are no cells, and the share is that of uniform candidates.
  const bool has_cells = p.near.share + p.far.share > 0.0;
  if (HAS_TRAFFIC != 0u && has_cells && p.vehicle_share > 0.0)
    p.vehicle_share *=
        vehicle_part(position, max(p.near.cell.strength_sum, p.far.cell.strength_sum));
  return p;
}

// Returns the density of this light among the samples from a cell's list, times the list's share. A
// light is in the list if its strength reaches the cell's threshold, so that the list need not be
// searched.
float cell_density(GridCell p, Light light) {
  if (!(p.share > 0.0)) return 0.0;
  const vec2 d = light.position.xz - p.centre;
  const float strength = light.flux_lm / (dot(d, d) + p.softening_m2);
  return strength >= p.cell.threshold && strength > 0.0 ? p.density * strength : 0.0;
}

uint sample_cell(GridCell p, LightGridBuffers grid) {
  const GridEntry entry = grid.entries.at[p.cell.first + random_below(p.cell.count)];
  return random_float() < entry.keep ? entry.light : entry.alias_light;
}

// Returns the density of a static light that shines among the samples of the mixture, whichever
// technique takes it.
float static_density(LightSampler p, Light light) {
  return p.uniform_density + p.power_density * light.flux_lm + cell_density(p.near, light) +
         cell_density(p.far, light);
}

SampledLight sample_static_light(LightSampler p, float technique) {
  SampledLight chosen;
  if (technique < p.near.share) {
    chosen.index = sample_cell(p.near, SCENE.near_grid);
  } else if (technique < p.near.share + p.far.share) {
    chosen.index = sample_cell(p.far, SCENE.far_grid);
  } else if (technique < p.near.share + p.far.share + p.uniform_share) {
    // Also where no light has a schedule: one may have been switched off by hand.
    chosen.index = SCENE.lit_list.at[random_below(SCENE.lit_count)];
  } else {
    chosen.index = random_below(SCENE.static_lights);
    const AliasEntry entry = SCENE.alias.at[chosen.index];
    if (random_float() >= entry.keep) chosen.index = entry.alias;
  }
  chosen.light = shining_light_at(chosen.index);
  chosen.pdf = static_density(p, chosen.light);
  return chosen;
}

// Returns which of a node's four children is sampled, each in proportion to its weight, and
// multiplies `pdf` by the probability of that; 4 where no child has weight.
uint sample_child(float weight[4], inout float pdf) {
  const float sum = weight[0] + weight[1] + weight[2] + weight[3];
  if (!(sum > 0.0)) return 4u;
  float at = random_float() * sum;
  uint chosen = 4u;
  for (uint i = 0u; i < 4u; ++i) {
    if (weight[i] <= 0.0) continue;
    chosen = i;  // the last one with weight, if rounding lets `at` run past the end
    if (at < weight[i]) break;
    at -= weight[i];
  }
  pdf *= weight[chosen] / sum;
  return chosen;
}

// Returns one of the lights of a vehicle, in proportion to flux; `pdf` is that of the vehicle.
SampledLight sample_light_of_vehicle(LightNode leaf, float pdf) {
  SampledLight chosen = NO_LIGHT;
  float at = random_float() * leaf.flux_lm;
  for (uint i = 0u; i < VEHICLE_LIGHTS; ++i) {
    const float flux = FRAME.vehicle_lights.at[leaf.item * VEHICLE_LIGHTS + i].flux_lm;
    if (flux <= 0.0) continue;
    chosen.index = leaf.item * VEHICLE_LIGHTS + i;
    chosen.pdf = pdf * flux / leaf.flux_lm;
    if (at < flux) break;
    at -= flux;
  }
  chosen.light = FRAME.vehicle_lights.at[chosen.index];
  chosen.index += SCENE.static_lights;
  return chosen;
}

SampledLight sample_vehicle_light(vec3 position) {
  const vec3 in_boxes = turn_to_boxes(position);
  float pdf = 1.0;
  uint place = 0u;
  for (uint level = SCENE.traffic.levels - 1u; level > 0u; --level) {
    float weight[4];
    for (uint i = 0u; i < 4u; ++i) {
      const uint below = 4u * place + i;
      weight[i] =
          below < SCENE.traffic.level_count[level - 1u]
              ? importance(FRAME.vehicle_nodes.at[SCENE.traffic.level_first[level - 1u] + below],
                           in_boxes)
              : 0.0;
    }
    const uint child = sample_child(weight, pdf);
    if (child == 4u) return NO_LIGHT;
    place = 4u * place + child;
  }
  return sample_light_of_vehicle(FRAME.vehicle_nodes.at[place], pdf);
}

// Returns one light for a receiver. `technique` in [0, 1) is stratified as described above.
SampledLight sample_light(LightSampler p, vec3 position, float technique) {
  SampledLight chosen;
  if (technique < p.vehicle_share) {
    chosen = sample_vehicle_light(position);
    chosen.pdf *= p.vehicle_share;
  } else {
    chosen = sample_static_light(p, (technique - p.vehicle_share) / (1.0 - p.vehicle_share));
    chosen.pdf *= 1.0 - p.vehicle_share;
  }
  return chosen;
}
