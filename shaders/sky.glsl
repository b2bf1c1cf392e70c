// Sky and moon: seen directly, and reflected by surfaces.

// Returns the luminance of the sky towards unit `direction`, cd/m^2 per channel.
vec3 sky_luminance(vec3 direction) {
  if (SKY_MODE != SKY_MAP) return FRAME.sky;
  // North in the middle, east to its right.
  const float turn = atan(direction.x, -direction.z) / (2.0 * PI) + 0.5;
  const float height = acos(clamp(direction.y, -1.0, 1.0)) / PI;
  const uint x = min(uint(turn * float(SCENE.sky_width)), SCENE.sky_width - 1u);
  const uint y = min(uint(height * float(SCENE.sky_height)), SCENE.sky_height - 1u);
  const uint at = 3u * (y * SCENE.sky_width + x);
  const vec3 base = direction.y > 0.0 ? FRAME.sky_base : vec3(0.0);
  const vec3 map = vec3(SCENE.sky_map.at[at], SCENE.sky_map.at[at + 1u], SCENE.sky_map.at[at + 2u]);
  return max(FRAME.sky * map + base, vec3(0.0));
}

// Returns what a pixel without a surface shows: the sky, and the moon's disc in it.
vec3 seen_sky(uvec2 pixel) {
  if (SKY_MODE == SKY_DARK) return vec3(0.0);
  const vec3 direction = camera_direction(pixel);
  const vec3 sky = sky_luminance(direction);
  const bool on_moon = dot(direction, FRAME.moon_direction) > 1.0 - 0.5 * MOON_RADIUS * MOON_RADIUS;
  return on_moon ? sky + FRAME.moon_lux / (PI * MOON_RADIUS * MOON_RADIUS) : sky;
}

// Returns what air in front of a surface adds of the sky's own light, cd/m^2 per channel: air in
// the light of an even sky is as bright as that sky where nothing shows through (Koschmieder 1924).
// Not in shadow, and of the sky at the horizon where the ray goes down. `passed` is the
// transmittance.
vec3 sky_airlight(vec3 direction, float passed) {
  if (AIR == AIR_CLEAR || SKY_MODE == SKY_DARK) return vec3(0.0);
  const vec3 level = vec3(direction.x, max(direction.y, 0.0), direction.z);
  const float size = length(level);
  const vec3 sky = sky_luminance(size > 0.0 ? level / size : vec3(0.0, 1.0, 0.0));
  return sky * (FRAME.air.albedo * (1.0 - passed));
}

// Returns one sample of the moonlight that a surface reflects, cd/m^2 per channel: u in [0, 1)^2 is
// a point on the moon's disc. It includes the moon's mirror image in a wet street.
vec3 reflected_moon(Receiver r, vec2 u) {
  if (luminance(FRAME.moon_lux) <= 0.0) return vec3(0.0);
  vec3 t, b;
  make_frame(FRAME.moon_direction, t, b);
  const float radius = MOON_RADIUS * sqrt(u.x), phi = 2.0 * PI * u.y;
  const vec3 direction =
      normalize(FRAME.moon_direction + t * (radius * cos(phi)) + b * (radius * sin(phi)));
  const vec3 light = reflected(r, LightSample(vec3(0.0), direction, FRAME.moon_lux));
  return luminance(light) > 0.0 && escapes(r.origin, direction) ? light : vec3(0.0);
}

// Returns one cosine-weighted sample of the skylight that a surface reflects, cd/m^2 per channel:
// reflectance * sky where the ray leaves the scene. The water film of a wet street is left out,
// because a dark sky adds nothing visible in it.
vec3 reflected_sky(Receiver r, vec2 u) {
  const vec3 direction = cosine_direction(r.normal, u);
  const vec3 sky = sky_luminance(direction);
  return luminance(sky) > 0.0 && escapes(r.origin, direction) ? r.reflectance * PI * sky
                                                              : vec3(0.0);
}

// Returns one sample of sky and moon together, reflected by a surface.
vec3 reflected_sky_and_moon(Receiver receiver) {
  if (SKY_MODE == SKY_DARK) return vec3(0.0);
  const vec3 sky = reflected_sky(receiver, vec2(random_float(), random_float()));
  return sky + reflected_moon(receiver, vec2(random_float(), random_float()));
}
