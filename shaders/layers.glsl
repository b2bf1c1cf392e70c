// What each kind of light gives a pixel, kept apart where somebody asks for it.

void add_direct(inout LightLayers layers, uint index, Light light, vec3 direct) {
  if (HAS_LAYERS == 0u) return;
  if (index >= SCENE.static_lights) layers.vehicles += direct;
  else if ((light.kind_profile & 255u) == LIGHT_RECTANGLE) layers.windows += direct;
  else layers.lamps += direct;
}

vec3 sound(vec3 v) { return finite(v.x) && finite(v.y) && finite(v.z) ? v : vec3(0.0); }

// Adds to the pixel's sums, or starts them anew.
void keep_layers(uint index, LightLayers layers, bool anew) {
  if (HAS_LAYERS == 0u) return;
  LightLayers sum = FRAME.layers.at[index];
  if (anew) sum = LightLayers(vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0), vec3(0.0));
  sum.lamps += sound(layers.lamps);
  sum.windows += sound(layers.windows);
  sum.vehicles += sound(layers.vehicles);
  sum.sky += sound(layers.sky);
  sum.emitted += sound(layers.emitted);
  FRAME.layers.at[index] = sum;
}

vec3 seen_sky(uvec2 pixel) {
  if (HAS_SKY == SKY_DARK) return vec3(0.0);
  const vec3 direction = camera_direction(pixel);
  const vec3 sky = sky_luminance(direction);
  const bool on_moon = dot(direction, FRAME.moon_direction) > 1.0 - 0.5 * MOON_RADIUS * MOON_RADIUS;
  return on_moon ? sky + FRAME.moon_lux / (PI * MOON_RADIUS * MOON_RADIUS) : sky;
}
