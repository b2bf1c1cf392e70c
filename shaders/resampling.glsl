// Resampled importance sampling (RIS) of a light for a receiver (after Bitterli et al. 2020, Alg.
// 3).

// Returns whether any light shines that could be sampled.
bool any_light_shines(LightSampler light_sampler) {
  return SCENE.near_grid.shape.width != 0u || light_sampler.vehicle_share > 0.0;
}

// A sampled point of a light, and its weight among the candidates.
struct Candidate {
  uint light;
  uint uv;
  float target;
  float weight;  // 0 = it brings no light
};

// Returns candidate i of `count`. Draws from the current stream.
Candidate draw_candidate(LightSampler light_sampler, Receiver receiver, uint i, uint count) {
  const float technique = min((float(i) + random_float()) / float(count), BELOW_ONE);
  const SampledLight chosen = sample_light(light_sampler, receiver.position, technique);
  const uint uv = random_uint();
  if (!(chosen.pdf > 0.0)) return Candidate(NO_HIT, 0u, 0.0, 0.0);
  const float p = target_of(receiver, chosen.light, uv, false);
  return Candidate(chosen.index, uv, p, p / (chosen.pdf * float(count)));
}

// Returns one of `candidates` sampled lights, chosen by its unshadowed target; whether it is in
// shadow is not known yet. Draws from the current stream.
Reservoir resample_lights(LightSampler light_sampler, Receiver receiver, uint candidates) {
  ReservoirBuilder builder = EMPTY_BUILDER;
  for (uint i = 0u; i < candidates; ++i) {
    const Candidate c = draw_candidate(light_sampler, receiver, i, candidates);
    update(builder, c.light, c.uv, c.target, c.weight);
  }
  builder.M = float(candidates);
  return finalize(builder, 1.0);
}
