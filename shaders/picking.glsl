// Picking lights: standing ones by a mixture of uniform, flux-proportional and local picks, these from two grids: the lights
// strong near a place, and those of the quarter around it, which the first has no room for. Vehicles' lights by going down
// the fleet's tree (after Conty Estevez, Kulla: Importance Sampling of Many Lights, 2018). The two sets are disjoint, so a
// pick's density is that of its own set's technique.
//
// Which technique makes a pick is stratified over a pixel's candidates: candidate i of n gets a number in
// [i / n, (i + 1) / n). Their mean density is the mixture's, so weights by the mixture stay exact (the balance heuristic;
// Veach 1997), and lanes that run in lockstep mostly take the same branch.

// A grid's cell at a place.
struct PickedCell {
  LightCell cell;
  vec2 centre;
  float share;  // of the candidates from standing lights
};

struct Picker {
  PickedCell near;
  PickedCell wide;
  float uniform_share;  // of the candidates from standing lights
  float power_share;
  float fleet_share;    // of all candidates
};

struct Pick {
  uint light;
  Light sampled;
  float pdf;  // 0: none
};

PickedCell cell_at(LightGridBuffers grid, vec3 position, float share) {
  PickedCell p;
  const LightGridShape shape = grid.shape;
  const vec2 origin = vec2(shape.origin_x, shape.origin_z);
  const vec2 at =
      clamp(floor((position.xz - origin) / shape.cell_m), vec2(0.0), vec2(shape.width, shape.depth) - 1.0);
  p.centre = origin + (at + 0.5) * shape.cell_m;
  p.cell = grid.cells.at[uint(at.y) * shape.width + uint(at.x)];
  p.share = p.cell.count > 0u ? share : 0.0;
  return p;
}

Picker picker_at(vec3 position) {
  Picker p;
  const bool any_standing = SCENE.local_grid.shape.width != 0u;
  p.near.share = p.wide.share = 0.0;
  if (any_standing) {
    p.near = cell_at(SCENE.local_grid, position, FRAME.local_share);
    p.wide = cell_at(SCENE.wide_grid, position, FRAME.wide_share);
  }
  p.uniform_share = FRAME.uniform_share;
  p.power_share = max(1.0 - p.near.share - p.wide.share - p.uniform_share, 0.0);
  p.fleet_share = HAS_TRAFFIC != 0u ? FRAME.fleet_share : 0.0;
  // Where one of the two sets is dark, the other has all candidates.
  if (!any_standing) p.fleet_share = HAS_TRAFFIC != 0u ? 1.0 : 0.0;
  else if (HAS_TRAFFIC != 0u && FRAME.fleet_nodes.at[SCENE.fleet.level_first[SCENE.fleet.levels - 1u]].flux_lm <= 0.0)
    p.fleet_share = 0.0;
  return p;
}

// Density of this light among the picks from a cell's list, times the list's share. Membership is decided by strength, so
// no list is searched.
float list_density(PickedCell p, LightGridShape shape, Light light) {
  if (!(p.share > 0.0)) return 0.0;
  const vec2 d = light.position.xz - p.centre;
  const float strength = light.flux_lm / (dot(d, d) + shape.softening_m2);
  return strength >= p.cell.threshold && strength > 0.0 ? p.share * strength / p.cell.strength_sum : 0.0;
}

uint pick_from(PickedCell p, LightGridBuffers grid) {
  const LocalEntry entry = grid.entries.at[p.cell.first + random_below(p.cell.count)];
  return random_float() < entry.keep ? entry.light : entry.alias_light;
}

Pick pick_standing(Picker p, float technique) {
  Pick pick;
  if (technique < p.near.share) {
    pick.light = pick_from(p.near, SCENE.local_grid);
  } else if (technique < p.near.share + p.wide.share) {
    pick.light = pick_from(p.wide, SCENE.wide_grid);
  } else if (technique < p.near.share + p.wide.share + p.uniform_share) {
    pick.light = random_below(SCENE.lit_count);
    if (HAS_SCHEDULES != 0u) pick.light = SCENE.lit_list.at[pick.light];
  } else {
    pick.light = random_below(SCENE.standing_lights);
    const AliasEntry entry = SCENE.alias.at[pick.light];
    if (random_float() >= entry.keep) pick.light = entry.alias;
  }
  pick.sampled = light_at(pick.light);
  // The mixture's density, whichever technique made the pick.
  pick.pdf = p.uniform_share / float(SCENE.lit_count) + p.power_share * SCENE.alias.at[pick.light].pdf +
             list_density(p.near, SCENE.local_grid.shape, pick.sampled) +
             list_density(p.wide, SCENE.wide_grid.shape, pick.sampled);
  return pick;
}

// What a node's lights may give here, but for their directions.
float importance(FleetNode node, vec3 position) {
  if (node.lower.x > node.upper.x) return 0.0;
  const vec3 d = 0.5 * (node.lower + node.upper) - position;
  const vec3 extent = node.upper - node.lower;
  return node.flux_lm / max(dot(d, d), 0.25 * dot(extent, extent) + 1.0);
}

Pick pick_fleet(vec3 position) {
  Pick pick = Pick(0u, SCENE.lights.at[0], 0.0);
  float pdf = 1.0;
  uint place = 0u;
  for (uint level = SCENE.fleet.levels - 1u; level > 0u; --level) {
    float weight[4];
    float sum = 0.0;
    for (uint i = 0u; i < 4u; ++i) {
      const uint below = 4u * place + i;
      weight[i] = below < SCENE.fleet.level_count[level - 1u]
                      ? importance(FRAME.fleet_nodes.at[SCENE.fleet.level_first[level - 1u] + below], position)
                      : 0.0;
      sum += weight[i];
    }
    if (!(sum > 0.0)) return pick;
    float at = random_float() * sum;
    uint chosen = 4u;
    for (uint i = 0u; i < 4u; ++i) {
      if (weight[i] <= 0.0) continue;
      chosen = i;  // the last with weight, where rounding lets `at` run past the end
      if (at < weight[i]) break;
      at -= weight[i];
    }
    pdf *= weight[chosen] / sum;
    place = 4u * place + chosen;
  }
  const FleetNode leaf = FRAME.fleet_nodes.at[place];
  float at = random_float() * leaf.flux_lm;
  for (uint i = 0u; i < VEHICLE_LIGHTS; ++i) {
    const float flux = FRAME.fleet_lights.at[leaf.trip * VEHICLE_LIGHTS + i].flux_lm;
    if (flux <= 0.0) continue;
    pick.light = leaf.trip * VEHICLE_LIGHTS + i;
    pick.pdf = pdf * flux / leaf.flux_lm;
    if (at < flux) break;
    at -= flux;
  }
  pick.sampled = FRAME.fleet_lights.at[pick.light];
  pick.light += SCENE.standing_lights;
  return pick;
}

// `technique` in [0, 1): stratified, as said above.
Pick pick_light(Picker p, vec3 position, float technique) {
  Pick pick;
  if (technique < p.fleet_share) {
    pick = pick_fleet(position);
    pick.pdf *= p.fleet_share;
  } else {
    pick = pick_standing(p, (technique - p.fleet_share) / (1.0 - p.fleet_share));
    pick.pdf *= 1.0 - p.fleet_share;
  }
  return pick;
}
