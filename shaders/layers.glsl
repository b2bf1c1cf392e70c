// The light of each kind of source in a pixel, kept apart where the settings ask for layers.

const LightLayers NO_LAYERS =
    LightLayers(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));

void add_direct(inout LightLayers layers, uint index, Light light, vec3 direct) {
  if (HAS_LAYERS == 0u) return;
  if (index >= SCENE.static_lights) layers.vehicles += direct;
  else add_to_layer(layers, light, direct);
}

// Weakens the light of a surface by what the air in front of it lets pass, and adds the sky's light
// that the air scatters.
void see_through_air(inout LightLayers layers, float passed, vec3 sky_airlight) {
  if (HAS_LAYERS == 0u || AIR == AIR_CLEAR) return;
  layers.lamps *= passed;
  layers.windows *= passed;
  layers.vehicles *= passed;
  layers.sky *= passed;
  layers.emitted *= passed;
  layers.indirect *= passed;
  layers.air += sky_airlight;
}

vec3 finite_or_zero(vec3 v) { return all_finite(v) ? v : vec3(0.0); }

void add_to_sum(inout vec3 sum, inout vec3 compensation, vec3 value) {
  add_compensated(sum, compensation, finite_or_zero(value));
}

// Adds to the pixel's sums; with `reset`, starts them again first.
void add_layers(uint index, LightLayers layers, bool reset) {
  if (HAS_LAYERS == 0u) return;
  LayerSums total = FRAME.layers.at[index];
  if (reset) total = LayerSums(NO_LAYERS, NO_LAYERS);
  add_to_sum(total.sum.lamps, total.compensation.lamps, layers.lamps);
  add_to_sum(total.sum.windows, total.compensation.windows, layers.windows);
  add_to_sum(total.sum.vehicles, total.compensation.vehicles, layers.vehicles);
  add_to_sum(total.sum.sky, total.compensation.sky, layers.sky);
  add_to_sum(total.sum.emitted, total.compensation.emitted, layers.emitted);
  add_to_sum(total.sum.air, total.compensation.air, layers.air);
  add_to_sum(total.sum.indirect, total.compensation.indirect, layers.indirect);
  FRAME.layers.at[index] = total;
}
