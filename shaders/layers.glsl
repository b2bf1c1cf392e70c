// The light of each kind of source in a pixel, kept apart where the settings ask for layers.

const LightLayers NO_LAYERS = LightLayers(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));

void add_direct(inout LightLayers layers, uint index, Light light, vec3 direct) {
  if (HAS_LAYERS == 0u) return;
  if (index >= SCENE.static_lights) layers.vehicles += direct;
  else add_to_layer(layers, light, direct);
}

vec3 finite_or_zero(vec3 v) { return all_finite(v) ? v : vec3(0.0); }

// Adds to the pixel's sums; with `reset`, starts them again first.
void add_layers(uint index, LightLayers layers, bool reset) {
  if (HAS_LAYERS == 0u) return;
  LightLayers sum = FRAME.layers.at[index];
  if (reset) sum = NO_LAYERS;
  sum.lamps += finite_or_zero(layers.lamps);
  sum.windows += finite_or_zero(layers.windows);
  sum.vehicles += finite_or_zero(layers.vehicles);
  sum.sky += finite_or_zero(layers.sky);
  sum.emitted += finite_or_zero(layers.emitted);
  FRAME.layers.at[index] = sum;
}
