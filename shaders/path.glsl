// Paths of light that bounces: from a surface that is seen, backwards to the lights. A path is
// followed by sampling the reflection (scatter), and gathers at each vertex the light that comes
// there straight from a light source, from the sky, and from a surface that glows by itself.
#include "shaders/roulette.glsl"

// A direction in which a receiver gathers light, sampled by what it reflects to its viewer.
struct Scatter {
  vec3 direction;  // unit
  vec3 weight;     // BRDF * cosine / density, at most about 1; 0 = nothing is reflected from there
};

// Returns the direction of one reflection, with probability `film_share` sampled by the water
// film's lobe, else by the diffuse one: u in [0, 1)^2 is a point of it, `choice` in [0, 1) chooses.
// Weighted by the density of both (multiple importance sampling by the balance heuristic; Veach
// 1997).
Scatter scatter(Receiver r, float film_share, float choice, vec2 u) {
  Scatter s = Scatter(vec3(0.0, 1.0, 0.0), vec3(0.0));
  if (choice < film_share) {
    const float cos2 = (1.0 - u.x) / (1.0 + (WET_ALPHA * WET_ALPHA - 1.0) * u.x);
    const float sine = sqrt(max(1.0 - cos2, 0.0)), phi = 2.0 * PI * u.y;
    vec3 t, b;
    make_frame(r.normal, t, b);
    const vec3 h = t * (sine * cos(phi)) + b * (sine * sin(phi)) + r.normal * sqrt(cos2);
    s.direction = reflect(-r.to_viewer, h);
  } else {
    s.direction = cosine_direction(r.normal, u);
  }
  const float cosine = dot(r.normal, s.direction);
  if (!(cosine > 0.0)) return s;
  vec3 brdf = r.reflectance;
  float density = (1.0 - film_share) * cosine / PI;
  if (film_share > 0.0) {
    const vec3 h = normalize(s.direction + r.to_viewer);
    const float n_h = dot(r.normal, h);
    density += film_share * film_normal_density(n_h) * n_h / (4.0 * dot(r.to_viewer, h));
    brdf += r.wetness * film_brdf(r, s.direction);
  }
  const vec3 weight = brdf * (cosine / density);
  if (all_finite(weight)) s.weight = weight;
  return s;
}

// Returns the share of directions that a receiver's water film samples, 0 where it has none.
float film_share_of(Receiver r) { return HAS_GLOSS != 0u ? 0.5 * r.wetness : 0.0; }

Scatter scatter(Receiver r, float choice, vec2 u) {
  return scatter(r, film_share_of(r), choice, u);
}

// Returns the light that a surface on a path emits by itself, cd/m^2 per channel. What belongs to a
// light source is left out: its light is sampled instead.
vec3 unsampled_emission(Surface surface) {
  return surface.light < SCENE.light_count ? vec3(0.0)
                                           : SCENE.materials.at[surface.material].emission;
}

// Returns the light that a receiver reflects straight from the light sources: an unbiased estimate
// by one light, resampled from `candidates` of them.
vec3 reflected_direct(Receiver r, uint candidates) {
  const LightSampler light_sampler = light_sampler_at(r.position);
  if (!any_light_shines(light_sampler)) return vec3(0.0);
  const Reservoir chosen = resample_lights(light_sampler, r, candidates);
  if (!(chosen.W > 0.0)) return vec3(0.0);
  const LightSample s = sample_point(light_at(chosen.light), uv_of(chosen.uv), r.position);
  return occluded(r.origin, s.point, false) ? vec3(0.0) : reflected(r, s) * chosen.W;
}

// Returns the light that comes along unit `direction` to `origin` after 1 to `bounces` reflections,
// and what glows by itself there; cd/m^2 per channel. One path: unbiased, noisy. Draws from the
// current stream.
vec3 bounced_radiance(vec3 origin, vec3 direction, uint bounces) {
  vec3 sum = vec3(0.0), throughput = vec3(1.0);
  for (uint bounce = 1u; bounce <= bounces; ++bounce) {
    Hit hit;
    const Surface surface = first_surface(origin, direction, hit);
    if (surface.depth <= 0.0) break;
    const Receiver r = receiver_seen_from(surface, origin, false);
    sum += throughput * (unsampled_emission(surface) + reflected_direct(r, BOUNCE_CANDIDATES) +
                         reflected_sky_and_moon(r));
    if (bounce == bounces) break;
    const float choice = random_float();
    const Scatter next = scatter(r, choice, vec2(random_float(), random_float()));
    throughput *= next.weight;
    if (!survives(throughput)) break;
    origin = r.origin;
    direction = next.direction;
  }
  return all_finite(sum) ? sum : vec3(0.0);
}
