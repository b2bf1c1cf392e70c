// Paths of light that bounces: from a surface that is seen, backwards to the lights. A path is
// followed by sampling the reflection (scatter), and gathers at each vertex the light that comes
// there straight from a light source, from the sky, and from a surface that glows by itself. What a
// path would seldom meet, a surface beside a lamp, is found by a ray from the lamp. Paths pass
// through what casts no shadow, the housings of lamps: what a housing blocks and reflects is part
// of its lamp's distribution already.
#include "shaders/roulette.glsl"

// A direction in which a receiver gathers light, sampled by what it reflects to its viewer.
struct Scatter {
  vec3 direction;  // unit
  float density;   // 1/sr
  vec3 weight;     // BRDF * cosine / density, at most about 1; 0 = nothing is reflected from there
};

// Returns the density of scatter()'s directions, 1/sr.
float scatter_density(Receiver r, float film_share, vec3 direction) {
  float density = (1.0 - film_share) * dot(r.normal, direction) / PI;
  if (film_share > 0.0) {
    const vec3 h = normalize(direction + r.to_viewer);
    const float n_h = dot(r.normal, h);
    density += film_share * film_normal_density(r.film_alpha, n_h) * n_h /
               (4.0 * dot(r.to_viewer, h));
  }
  return density;
}

// Returns the direction of one reflection, with probability `film_share` sampled by the water
// film's lobe, else by the diffuse one: u in [0, 1)^2 is a point of it, `choice` in [0, 1) chooses.
// Weighted by the density of both (multiple importance sampling by the balance heuristic; Veach
// 1997).
Scatter scatter(Receiver r, float film_share, float choice, vec2 u) {
  Scatter s = Scatter(vec3(0.0, 1.0, 0.0), 0.0, vec3(0.0));
  if (choice < film_share) {
    const float cos2 = (1.0 - u.x) / (1.0 + (r.film_alpha * r.film_alpha - 1.0) * u.x);
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
  s.density = scatter_density(r, film_share, s.direction);
  const vec3 weight = brdf(r, s.direction) * (cosine / s.density);
  if (all_finite(weight)) s.weight = weight;
  return s;
}

// Returns the light that a surface on a path emits by itself, cd/m^2 per channel. What belongs to a
// light source is left out, as are the lenses of vehicles: their light is sampled instead.
vec3 unsampled_emission(Surface surface, Hit hit) {
  const bool of_vehicle =
      HAS_TRAFFIC != 0u && (SCENE.instances.at[hit.instance].mask & MASK_VEHICLE) != 0u;
  return of_vehicle || surface.light < SCENE.light_count
             ? vec3(0.0)
             : emission_of(surface.material);
}

// Returns the light that a receiver reflects straight from the light sources: an unbiased estimate
// by one light, resampled from `candidates` of them.
vec3 reflected_direct(Receiver r, uint candidates) {
  const LightSampler light_sampler = light_sampler_at(r.position);
  if (!any_light_shines(light_sampler)) return vec3(0.0);
  const Reservoir chosen = resample_lights(light_sampler, r, candidates);
  if (!(chosen.W > 0.0)) return vec3(0.0);
  const LightSample s = sample_point(light_at(chosen.light), uv_of(chosen.uv), r.position);
  return occluded(r.origin, s.point, false)
             ? vec3(0.0)
             : reflected(r, s) * (share_of_path(r, s.point) * chosen.W);
}

// Returns the receiver at the surface where a path from `r` went on, along a direction of this
// density; its film has this alpha.
Receiver next_receiver(Receiver r, Surface surface, float density, float film_alpha) {
  Receiver next = receiver_seen_from(surface, r.origin, false);
  next.film_alpha = film_alpha;
  next.path_density = density / (surface.depth * surface.depth);
  return next;
}

// Returns the light that a receiver reflects after one more reflection, at a surface which a ray
// from a light finds: an unbiased estimate of what reflected_direct() leaves out at the next
// receiver of a path, by one ray, resampled from `candidates` of them. A path seldom meets the few
// square centimetres beside a lamp, which shine a thousand times brighter than all else; a ray from
// the lamp seldom misses them (bidirectional path tracing; Lafortune, Willems 1993; Veach, Guibas
// 1994). Weighted by both densities, neither ever carries more than about twice what the lamp would
// send here straight.
vec3 reflected_from_lit_surface(Receiver r, float film_share, float film_alpha, uint candidates) {
  const LightSampler light_sampler = light_sampler_at(r.position);
  if (!any_light_shines(light_sampler)) return vec3(0.0);
  SampledLight source;
  EmittedRay ray;
  float sum = 0.0, target = 0.0;
  for (uint i = 0u; i < candidates; ++i) {
    const float technique = min((float(i) + random_float()) / float(candidates), BELOW_ONE);
    const SampledLight candidate = sample_light(light_sampler, r.position, technique);
    if (!(candidate.pdf > 0.0)) continue;
    const EmittedRay emitted_ray = emit_ray(candidate.light, vec2(random_float(), random_float()));
    const vec3 way = candidate.light.position - r.position;
    const float p = candidate.light.flux_lm * emitted_ray.share /
                    (dot(way, way) + bounding_radius2(candidate.light));
    const float weight = p / (candidate.pdf * float(candidates));
    if (!(weight > 0.0) || !finite(weight)) continue;
    sum += weight;
    if (random_float() * sum >= weight) continue;
    source = candidate;
    ray = emitted_ray;
    target = p;
  }
  if (!(target > 0.0)) return vec3(0.0);
  Hit hit;
  const Surface surface = first_surface(ray.origin, ray.direction, MASK_SHADOW, WIDE_SPREAD, hit);
  if (surface.depth <= 0.0) return vec3(0.0);
  Receiver lit = next_receiver(r, surface, 0.0, film_alpha);
  const vec3 way = lit.position - r.position;
  const float d2 = dot(way, way);
  const vec3 direction = way * inversesqrt(d2);
  const float cosine = dot(r.normal, direction), cosine_there = -dot(lit.normal, direction);
  if (!(cosine > 0.0) || !(cosine_there > 0.0)) return vec3(0.0);
  if (!unblocked(r.origin, lit.origin)) return vec3(0.0);
  const vec3 lumen = light_colour(source.light.colour_rgb9e5) *
                     (source.light.flux_lm * share_at(source.light, lit.position) * sum / target);
  // A path to `lit` has the rest of the weight.
  lit.path_density = scatter_density(r, film_share, direction) / d2;
  const float passed = transmittance(ray.origin, lit.position) *
                       transmittance(lit.position, r.position);
  const vec3 light = brdf(r, direction) * brdf(lit, -ray.direction) * lumen *
                     (passed * cosine * cosine_there / d2 *
                      (1.0 - share_of_path(lit, ray.origin)));
  return all_finite(light) ? light : vec3(0.0);
}

// Returns the light that a receiver reflects after 1 to `bounces` reflections elsewhere, and from
// what glows by itself; cd/m^2 per channel. One path: unbiased, noisy. `film_share`, `choice` and
// `u` sample its first direction, as in scatter(); `film_alpha` is that of water films elsewhere.
// Draws from the current stream.
vec3 reflected_bounces(Receiver r, float film_share, float choice, vec2 u, float film_alpha,
                       uint bounces) {
  vec3 sum = vec3(0.0), throughput = vec3(1.0);
  for (uint bounce = 1u; bounce <= bounces; ++bounce) {
    sum += throughput * reflected_from_lit_surface(r, film_share, film_alpha, BOUNCE_CANDIDATES);
    const Scatter s = scatter(r, film_share, choice, u);
    throughput *= s.weight;
    // The first bounce is worth its rays even off a dark surface.
    if (bounce == 1u ? !(luminance(throughput) > 0.0) : !survives(throughput)) break;
    Hit hit;
    const Surface surface = first_surface(r.origin, s.direction, MASK_SHADOW, WIDE_SPREAD, hit);
    if (surface.depth <= 0.0) break;
    throughput *= transmittance(r.position, surface.position);
    r = next_receiver(r, surface, s.density, film_alpha);
    sum += throughput * (unsampled_emission(surface, hit) + reflected_direct(r, BOUNCE_CANDIDATES) +
                         reflected_sky_and_moon(r));
    film_share = film_share_of(r);
    choice = random_float();
    u = vec2(random_float(), random_float());
  }
  return all_finite(sum) ? sum : vec3(0.0);
}
