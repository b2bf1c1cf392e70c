// What a visible surface makes of a light sample: the integrand f(y), and its luminance, the target function.

struct Receiver {
  vec3 position;
  vec3 normal;
  vec3 origin;      // of shadow rays
  vec3 reflectance; // base colour / pi
  bool before;      // of the frame before, lit by its lights
};

Receiver receiver_of(Surface surface) {
  Receiver r;
  r.position = surface.position;
  r.normal = unpack_normal(surface.normal);
  r.origin = offset_origin(surface.position, r.normal, surface.depth);
  r.reflectance = SCENE.materials.at[surface.material].base_colour * (1.0 / PI);
  r.before = false;
  return r;
}

// Unshadowed reflected light per unit of uv, cd/m^2 per channel.
vec3 reflected(Receiver r, LightSample s) {
  return r.reflectance * s.value * max(dot(r.normal, s.direction), 0.0);
}

// The target function p^: unshadowed, >= 0, finite. A light that is gone or out of range has none.
float target_of(Receiver r, Light light, uint uv) {
  const float p = luminance(reflected(r, sample_light(light, uv_of(uv), r.position)));
  return p > 0.0 && finite(p) ? p : 0.0;
}

float target(Receiver r, uint light, uint uv) {
  return light < SCENE.light_count ? target_of(r, light_at(light, r.before), uv) : 0.0;
}

bool sees(Receiver r, uint light, uint uv) {
  return !occluded(r.origin, sample_light(light_at(light, r.before), uv_of(uv), r.position).point);
}

// One cosine-weighted sample of a uniform sky: reflectance * sky where the ray leaves the scene, cd/m^2 per channel.
vec3 reflected_sky(Receiver r, vec2 u) {
  vec3 t, b;
  make_frame(r.normal, t, b);
  const float radius = sqrt(u.x), phi = 2.0 * PI * u.y;
  const vec3 direction = t * (radius * cos(phi)) + b * (radius * sin(phi)) + r.normal * sqrt(max(1.0 - u.x, 0.0));
  return escapes(r.origin, direction) ? r.reflectance * PI * FRAME.sky : vec3(0.0);
}

// Light the surface sends out by itself towards the eye, cd/m^2 per channel.
vec3 emitted(Surface surface) {
  const vec3 own = SCENE.materials.at[surface.material].emission;
  if (surface.light >= SCENE.light_count || luminance(own) <= 0.0) return own;
  // Emitter geometry: the light's own luminance, so that what is seen is what lights the street.
  return seen_luminance(light_at(surface.light), normalize(FRAME.camera.position - surface.position));
}
