// What a visible surface makes of a light sample: the integrand f(y), and its luminance, the target function.

struct Receiver {
  vec3 position;
  vec3 normal;
  vec3 origin;      // of shadow rays
  vec3 reflectance; // base colour / pi
  vec3 to_camera;      // unit
  float wetness;    // of its water film, 0 .. 1
  bool before;      // of the frame before, lit by its lights
};

// Wet asphalt: a film of water over it. Water's reflectance at normal incidence ((1.33 - 1) / (1.33 + 1))^2, a roughness
// that a street's puddles and grain have between them, and the share of its diffuse light that a soaked porous surface
// keeps (measured values of 0.4 to 0.7: Lekner, Dorf: Why some things are darker when wet, 1988).
const float WATER_F0 = 0.02;
const float WET_ROUGHNESS = 0.25;  // alpha = roughness^2
const float WET_DIFFUSE = 0.6;

Receiver receiver_of(Surface surface, bool before) {
  Receiver r;
  r.position = surface.position;
  r.normal = unpack_normal(surface.normal);
  r.origin = offset_origin(surface.position, r.normal, surface.depth);
  r.reflectance = SCENE.materials.at[surface.material].base_colour * (1.0 / PI);
  r.to_camera = r.normal;
  r.wetness = 0.0;
  r.before = before;
  if (HAS_GLOSS != 0u) {
    // Rain stays where a surface faces up.
    r.wetness = FRAME.wetness * smoothstep(0.7, 0.95, r.normal.y);
    r.to_camera = normalize((before ? FRAME.previous_camera.position : FRAME.camera.position) - surface.position);
    r.reflectance *= mix(1.0, WET_DIFFUSE, r.wetness);
  }
  return r;
}

Receiver receiver_of(Surface surface) { return receiver_of(surface, false); }

// Of the water film: GGX with Smith's height-correlated shadowing (Heitz 2014) and Schlick's Fresnel term.
float film_brdf(Receiver r, vec3 to_light) {
  const vec3 h = normalize(to_light + r.to_camera);
  const float n_l = dot(r.normal, to_light), n_v = max(dot(r.normal, r.to_camera), 1e-4), n_h = dot(r.normal, h);
  const float alpha2 = WET_ROUGHNESS * WET_ROUGHNESS * WET_ROUGHNESS * WET_ROUGHNESS;
  const float d = n_h * n_h * (alpha2 - 1.0) + 1.0;
  const float distribution = alpha2 / (PI * d * d);
  const float shadowing = 0.5 / (n_l * sqrt(n_v * n_v * (1.0 - alpha2) + alpha2) + n_v * sqrt(n_l * n_l * (1.0 - alpha2) + alpha2));
  const float fresnel = WATER_F0 + (1.0 - WATER_F0) * pow(1.0 - clamp(dot(to_light, h), 0.0, 1.0), 5.0);
  return distribution * shadowing * fresnel;
}

// Unshadowed reflected light per unit of uv, cd/m^2 per channel.
vec3 reflected(Receiver r, LightSample s) {
  const float cosine = dot(r.normal, s.direction);
  if (!(cosine > 0.0)) return vec3(0.0);
  vec3 brdf = r.reflectance;
  if (HAS_GLOSS != 0u && r.wetness > 0.0) brdf += r.wetness * film_brdf(r, s.direction);
  return brdf * s.value * cosine;
}

// The target function p^: unshadowed, >= 0, finite. A light that is gone or out of range has none.
float target_of(Receiver r, Light light, uint uv) {
  const float p = luminance(reflected(r, sample_point(light, uv_of(uv), r.position)));
  return p > 0.0 && finite(p) ? p : 0.0;
}

float target(Receiver r, uint light, uint uv) {
  return light < SCENE.light_count ? target_of(r, light_at(light, r.before), uv) : 0.0;
}

bool sees(Receiver r, uint light, uint uv) {
  return !occluded(r.origin, sample_point(light_at(light, r.before), uv_of(uv), r.position).point);
}

// Luminance of the sky towards unit `direction`, cd/m^2 per channel.
vec3 sky_luminance(vec3 direction) {
  if (HAS_SKY != SKY_MAP) return FRAME.sky;
  const float turn = atan(direction.x, -direction.z) / (2.0 * PI) + 0.5;  // north in the middle, east to its right
  const float height = acos(clamp(direction.y, -1.0, 1.0)) / PI;
  const uint x = min(uint(turn * float(SCENE.sky_width)), SCENE.sky_width - 1u);
  const uint y = min(uint(height * float(SCENE.sky_height)), SCENE.sky_height - 1u);
  const uint at = 3u * (y * SCENE.sky_width + x);
  return FRAME.sky * vec3(SCENE.sky_map.at[at], SCENE.sky_map.at[at + 1u], SCENE.sky_map.at[at + 2u]);
}

// The moon's: a point of its disc, and what the wet street mirrors of it too.
vec3 reflected_moon(Receiver r, vec2 u) {
  if (luminance(FRAME.moon_lux) <= 0.0) return vec3(0.0);
  vec3 t, b;
  make_frame(FRAME.moon_direction, t, b);
  const float radius = MOON_RADIUS * sqrt(u.x), phi = 2.0 * PI * u.y;
  const vec3 direction = normalize(FRAME.moon_direction + t * (radius * cos(phi)) + b * (radius * sin(phi)));
  const vec3 light = reflected(r, LightSample(vec3(0.0), direction, FRAME.moon_lux));
  return luminance(light) > 0.0 && escapes(r.origin, direction) ? light : vec3(0.0);
}

// One cosine-weighted sample of the sky: reflectance * sky where the ray leaves the scene, cd/m^2 per channel. The film of
// a wet street is left out: a dark sky adds nothing to see in it.
vec3 reflected_sky(Receiver r, vec2 u) {
  const vec3 direction = cosine_direction(r.normal, u);
  const vec3 sky = sky_luminance(direction);
  return luminance(sky) > 0.0 && escapes(r.origin, direction) ? r.reflectance * PI * sky : vec3(0.0);
}

// Light the surface sends out by itself towards the eye, cd/m^2 per channel.
vec3 emitted(Surface surface) {
  const vec3 own = SCENE.materials.at[surface.material].emission;
  if (surface.light >= SCENE.light_count || luminance(own) <= 0.0) return own;
  // Emitter geometry: the light's own luminance, so that what is seen is what lights the street.
  return seen_luminance(light_at(surface.light), normalize(FRAME.camera.position - surface.position));
}
