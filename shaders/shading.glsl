// Reflection of a light sample by a visible surface: the integrand f(y), and its luminance, the
// target function.

struct Receiver {
  vec3 position;
  vec3 normal;
  vec3 origin;      // of shadow rays
  vec3 reflectance; // base colour / pi
  vec3 to_viewer;   // unit; to the camera or, on a path, to the vertex before
  float wetness;    // of its water film, 0 .. 1
  float film_alpha; // the square of the film's roughness
  bool before;      // a point of the frame before: its lights light it, its geometry shadows it
  float path_density;  // of the paths that meet it, 1/m^2, or ONLY_PATH
};

// The path density of a receiver that rays from lights do not sample as well (shaders/path.glsl).
const float ONLY_PATH = 1e30;

// Returns the weight of a path that was followed to a receiver before a point of a light was
// chosen, against that of a ray from that point which meets the receiver (multiple importance
// sampling by the balance heuristic; Veach 1997). Such a ray has a density of 1 / (4 pi d^2) times
// a cosine, which the path's density has too.
float share_of_path(Receiver r, vec3 light_point) {
  if (r.path_density == ONLY_PATH) return 1.0;
  const vec3 way = light_point - r.position;
  const float ratio = min(r.path_density * 4.0 * PI * dot(way, way), 1e30);
  return ratio / (1.0 + ratio);
}

// Wet asphalt is asphalt under a film of water: water's reflectance at normal incidence ((1.33 - 1)
// / (1.33 + 1))^2, a roughness between that of puddles and of the street's grain, and the share of
// its diffuse light that a soaked porous surface keeps (measured: 0.4 to 0.7; Lekner, Dorf: Why
// some things are darker when wet, 1988).
const float WATER_F0 = 0.02;
const float WET_ALPHA = 0.0625;  // the square of a roughness of 0.25
const float WET_DIFFUSE = 0.6;

// Returns the share of directions that a receiver's water film samples, 0 where it has none.
float film_share_of(Receiver r) { return HAS_GLOSS != 0u ? 0.5 * r.wetness : 0.0; }

// Returns the receiver at a surface that is seen from `viewer`.
Receiver receiver_seen_from(Surface surface, vec3 viewer, bool before) {
  Receiver r;
  r.position = surface.position;
  r.normal = unpack_normal(surface.normal, surface.clearance_and_rest);
  r.origin = surface.position + r.normal * clearance_of(surface);
  r.reflectance = base_colour_of(surface.material) * (1.0 / PI);
  r.to_viewer = r.normal;
  r.wetness = 0.0;
  r.film_alpha = WET_ALPHA;
  r.before = before;
  r.path_density = ONLY_PATH;
  if (HAS_GLOSS != 0u) {
    // Rain and water stay where a surface faces up. What is below water is not darkened by rain.
    const bool water = roughness_of(surface.material) < WATER_ROUGHNESS;
    const float facing = smoothstep(0.7, 0.95, r.normal.y);
    r.wetness = (water ? 1.0 : FRAME.wetness) * facing;
    r.to_viewer = normalize(viewer - surface.position);
    if (!water) r.reflectance *= mix(1.0, WET_DIFFUSE, r.wetness);
  }
  return r;
}

Receiver receiver_of(Surface surface, bool before) {
  return receiver_seen_from(
      surface, before ? FRAME.previous_camera.position : FRAME.camera.position, before);
}

Receiver receiver_of(Surface surface) { return receiver_of(surface, false); }

// Returns the density of the film's microfacet normals at a cosine with the surface's normal (GGX;
// Walter et al. 2007), 1/sr.
float film_normal_density(float film_alpha, float n_h) {
  const float alpha2 = film_alpha * film_alpha;
  const float d = n_h * n_h * (alpha2 - 1.0) + 1.0;
  return alpha2 / (PI * d * d);
}

// Returns the water film's BRDF: GGX with Smith's height-correlated shadowing (Heitz 2014) and
// Schlick's Fresnel term.
float film_brdf(Receiver r, vec3 to_light) {
  const vec3 h = normalize(to_light + r.to_viewer);
  const float n_l = dot(r.normal, to_light), n_v = max(dot(r.normal, r.to_viewer), 1e-4),
              n_h = dot(r.normal, h);
  const float alpha2 = r.film_alpha * r.film_alpha;
  const float distribution = film_normal_density(r.film_alpha, n_h);
  const float shadowing = 0.5 / (n_l * sqrt(n_v * n_v * (1.0 - alpha2) + alpha2) +
                                 n_v * sqrt(n_l * n_l * (1.0 - alpha2) + alpha2));
  const float fresnel =
      WATER_F0 + (1.0 - WATER_F0) * pow(1.0 - clamp(dot(to_light, h), 0.0, 1.0), 5.0);
  return distribution * shadowing * fresnel;
}

// Returns the BRDF for light from a direction above the surface, 1/sr per channel.
vec3 brdf(Receiver r, vec3 to_light) {
  if (HAS_GLOSS == 0u || !(r.wetness > 0.0)) return r.reflectance;
  return r.reflectance + r.wetness * film_brdf(r, to_light);
}

// Returns the reflected light per unit of uv, without shadows, cd/m^2 per channel.
vec3 reflected(Receiver r, LightSample s) {
  const float cosine = dot(r.normal, s.direction);
  return cosine > 0.0 ? brdf(r, s.direction) * s.value * cosine : vec3(0.0);
}

const ReflectedSample NOTHING_REFLECTED = ReflectedSample(vec3(0.0), 1.0);

// Returns what a receiver reflects of a sample, nothing where that is not finite. With `shadowed`
// it is also nothing where something casts a shadow between receiver and sample.
ReflectedSample reflected_sample_of(Receiver r, Light light, uint uv, bool shadowed) {
  const LightSample s = sample_in_clear_air(light, uv_of(uv), r.position);
  const vec3 in_clear_air = reflected(r, s) * share_of_path(r, s.point);
  const float p = luminance(in_clear_air);
  if (!(p > 0.0 && finite(p))) return NOTHING_REFLECTED;
  if (shadowed && occluded(r.origin, s.point, r.before)) return NOTHING_REFLECTED;
  return ReflectedSample(in_clear_air, transmittance(s.point, r.position));
}

// As above, by the light's index; nothing for an index out of range.
ReflectedSample reflected_sample(Receiver r, uint light, uint uv, bool shadowed) {
  return light < SCENE.light_count
             ? reflected_sample_of(r, light_at(light, r.before), uv, shadowed)
             : NOTHING_REFLECTED;
}

// Returns the target function p^, >= 0 and finite: without air, and with `shadowed` 0 where
// something casts a shadow.
float target_of(ReflectedSample s) { return luminance(s.in_clear_air); }

float target_of(Receiver r, Light light, uint uv, bool shadowed) {
  return target_of(reflected_sample_of(r, light, uv, shadowed));
}

// As above, by the light's index; 0 for an index out of range.
float target(Receiver r, uint light, uint uv, bool shadowed) {
  return target_of(reflected_sample(r, light, uv, shadowed));
}

float target(Receiver r, uint light, uint uv) { return target(r, light, uv, false); }

// Returns whether nothing casts a shadow between the receiver and the sample; false for an index
// out of range.
bool sees(Receiver r, uint light, uint uv) {
  if (light >= SCENE.light_count) return false;
  const vec3 point = sample_point(light_at(light, r.before), uv_of(uv), r.position).point;
  return !occluded(r.origin, point, r.before);
}

// Returns the estimator's target: with visibility where the estimator includes it.
float estimator_target(Receiver r, uint light, uint uv) {
  return target(r, light, uv, has_shadowed_target(ESTIMATOR));
}

// Returns the light that a surface emits towards the camera, cd/m^2 per channel.
vec3 emitted(Surface surface) {
  const vec3 own = emission_of(surface.material);
  if (surface.light >= SCENE.light_count || luminance(own) <= 0.0) return own;
  // A light's emitting surface shows the light's own luminance, so that what is seen is what lights
  // the street.
  return seen_luminance(light_at(surface.light),
                        normalize(FRAME.camera.position - surface.position));
}
