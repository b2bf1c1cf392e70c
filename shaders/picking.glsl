// Picking lights: standing ones by a mixture of uniform, flux-proportional and local picks; vehicles' lights by going down
// the fleet's tree (after Conty Estevez, Kulla: Importance Sampling of Many Lights, 2018). The two sets are disjoint, so a
// pick's density is that of its own set's technique.
//
// Which technique makes a pick is stratified over a pixel's candidates: candidate i of n gets a number in
// [i / n, (i + 1) / n). Their mean density is the mixture's, so weights by the mixture stay exact (the balance heuristic;
// Veach 1997), and lanes that run in lockstep mostly take the same branch.

struct Picker {
  LightCell cell;
  vec2 cell_centre;
  float fleet_share;    // of all candidates
  float local_share;    // of those from standing lights
  float uniform_share;
};

struct Pick {
  uint light;
  Light sampled;
  float pdf;  // 0: none
};

Picker picker_at(vec3 position) {
  Picker p;
  const LightGridShape grid = SCENE.grid;
  p.local_share = 0.0;
  p.uniform_share = FRAME.uniform_share;
  if (grid.width != 0u) {
    const vec2 at = clamp(floor((position.xz - vec2(grid.origin_x, grid.origin_z)) / grid.cell_m), vec2(0.0),
                          vec2(grid.width, grid.depth) - 1.0);
    p.cell_centre = vec2(grid.origin_x, grid.origin_z) + (at + 0.5) * grid.cell_m;
    p.cell = SCENE.cells.at[uint(at.y) * grid.width + uint(at.x)];
    if (p.cell.count > 0u) p.local_share = FRAME.local_share;
  }
  p.fleet_share = HAS_TRAFFIC != 0u ? FRAME.fleet_share : 0.0;
  // Where one of the two sets is dark, the other has all candidates.
  if (grid.width == 0u) p.fleet_share = HAS_TRAFFIC != 0u ? 1.0 : 0.0;
  else if (HAS_TRAFFIC != 0u && FRAME.fleet_nodes.at[SCENE.fleet.level_first[SCENE.fleet.levels - 1u]].flux_lm <= 0.0)
    p.fleet_share = 0.0;
  return p;
}

// Probability that the cell's list gives this light: membership is decided by strength, so no list is searched.
float local_pdf(Picker p, Light light) {
  const vec2 d = light.position.xz - p.cell_centre;
  const float strength = light.flux_lm / (dot(d, d) + SCENE.grid.softening_m2);
  return strength >= p.cell.threshold && strength > 0.0 ? strength / p.cell.strength_sum : 0.0;
}

Pick pick_standing(Picker p, float technique) {
  Pick pick;
  if (technique < p.local_share) {
    const LocalEntry entry = SCENE.local_entries.at[p.cell.first + random_below(p.cell.count)];
    pick.light = random_float() < entry.keep ? entry.light : entry.alias_light;
  } else if (technique < p.local_share + p.uniform_share) {
    pick.light = random_below(SCENE.lit_count);
    if (HAS_SCHEDULES != 0u) pick.light = SCENE.lit_list.at[pick.light];
  } else {
    pick.light = random_below(SCENE.standing_lights);
    const AliasEntry entry = SCENE.alias.at[pick.light];
    if (random_float() >= entry.keep) pick.light = entry.alias;
  }
  pick.sampled = light_at(pick.light);
  // The mixture's density, whichever technique made the pick.
  pick.pdf = p.uniform_share / float(SCENE.lit_count) +
             max(1.0 - p.local_share - p.uniform_share, 0.0) * SCENE.alias.at[pick.light].pdf;
  if (p.local_share > 0.0) pick.pdf += p.local_share * local_pdf(p, pick.sampled);
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
