// Samples of the light that air scatters towards the eye: a place on the ray, a light, a point on
// the light.

// The part of a ray that air is sampled on, from the eye to the surface that is seen.
struct AirRay {
  vec3 origin;
  vec3 direction;  // unit
  float depth;     // m
  // The plane of the surface: dot(normal, place) = offset; the normal is 0 where none is seen.
  vec3 normal;
  float offset;
};

AirRay air_ray(vec3 origin, vec3 direction, Surface surface) {
  const bool ends = surface.depth > 0.0;
  const vec3 normal = ends ? unpack_normal(surface.normal) : vec3(0.0);
  return AirRay(origin, direction, ends ? surface.depth : AIR_FAR, normal,
                dot(normal, surface.position));
}

// Lights behind the surface that is seen get this share of the samples that they would get: the
// surface hides most of them from the air in front, as a wall hides the lights of the next street.
const float HIDDEN_SHARE = 0.05;

// Returns HIDDEN_SHARE for a sphere behind the surface that is seen, else 1.
float likely_seen(AirRay ray, vec3 centre, float radius) {
  return dot(ray.normal, centre) - ray.offset < -radius - 0.5 ? HIDDEN_SHARE : 1.0;
}

// Returns the point of a light that uv in [0, 1)^2 stands for, and what it would send to a place in
// the air if the air were clear. Air touches windows, where surfaces stay centimetres off: there a
// rectangle is sampled by solid angle, which the passes of surfaces would pay for and not need.
LightSample sample_from_air(Light light, vec2 uv, vec3 place) {
  LightSample s;
  if (kind_here(light) == LIGHT_RECTANGLE && sample_rectangle_angle(light, uv, place, s)) return s;
  return sample_in_clear_air(light, uv, place);
}

// Returns the light that a light's point sends through the air at a distance along the ray to the
// eye, without shadows: cd/m^2 per channel, m of the ray and unit of uv. `point` is that point.
vec3 scattered(AirRay ray, Light light, vec2 uv, float distance, out vec3 point) {
  const vec3 place = ray.origin + ray.direction * distance;
  const LightSample s = sample_from_air(light, uv, place);
  point = s.point;
  return s.value * (phase(dot(ray.direction, s.direction)) * scattering_at(place) *
                    exp(-depth_of_air(point, place) - depth_of_air(place, ray.origin)));
}

// Returns tan(theta / 2) of the angle theta by which a light's ray turns towards the eye, `x`
// heights behind the place of the ray that is nearest to the light.
float half_turn(float x) {
  const float r = sqrt(1.0 + x * x);
  return x < 0.0 ? 1.0 / (r - x) : r + x;
}

// The air on a ray as a light sees it. Air is lit by 1 / d^2, which is evenly in the angle theta at
// which the light sees the ray (equi-angular sampling; Kulla, Fajardo: Importance sampling
// techniques for path tracing in participating media, 2012), and scatters by the phase function,
// which 1 / (1 + g^2 - 2 g cos theta) follows, its power of 2/3. The product of the two can be
// integrated: with k = (1 + g) / (1 - g), atan(k tan(theta / 2)) is spread evenly.
struct AirView {
  float nearest;  // distance along the ray of the place that is nearest to the light, m
  float height;   // of the light off the ray, m, at least `least`
  float k;
  float y0;       // half_turn() at the eye
  float range;    // of the angle atan(k tan(theta / 2)) along the ray
};

AirView air_seen_from(vec3 place, AirRay ray, float least) {
  AirView view;
  const vec3 way = place - ray.origin;
  view.nearest = dot(way, ray.direction);
  const vec3 off = way - ray.direction * view.nearest;
  view.height = sqrt(dot(off, off) + least * least);
  view.k = (1.0 + FRAME.air.asymmetry) / (1.0 - FRAME.air.asymmetry);
  const float x0 = -view.nearest / view.height, x1 = (ray.depth - view.nearest) / view.height;
  const float y1 = half_turn(x1);
  view.y0 = half_turn(x0);
  // y1 - y0, without taking near numbers from each other.
  const float y_range = ray.depth / view.height * (view.y0 + y1) /
                        (sqrt(1.0 + x0 * x0) + sqrt(1.0 + x1 * x1));
  view.range = atan(view.k * y_range, 1.0 + view.k * view.k * view.y0 * y1);
  return view;
}

// A distance along a ray, and its density, 1/m.
struct AirDistance {
  float distance;
  float density;
};

// Returns a distance along a ray, m, sampled by u in [0, 1) as the light lights the air there and
// the air scatters it to the eye.
AirDistance sample_distance(AirRay ray, Light light, float u) {
  // No closer than the light is large: a ray through a lamp sees air around it alone.
  const float least = 0.5 * sqrt(bounding_radius2(light)) + MIN_RADIUS;
  const AirView view = air_seen_from(light.position, ray, least);
  const float turn = tan(u * view.range), ky0 = view.k * view.y0;
  const float y_sampled = (ky0 + turn) / (view.k * (1.0 - ky0 * turn));
  const float distance =
      clamp(view.nearest + 0.5 * view.height * (y_sampled - 1.0 / y_sampled), 0.0, ray.depth);
  const float x = (distance - view.nearest) / view.height, ky = view.k * half_turn(x);
  return AirDistance(distance,
                     ky / ((1.0 + ky * ky) * sqrt(1.0 + x * x) * view.height * view.range));
}

// Returns an estimate of what a node's lights send through the air on a ray to the eye, whatever
// their directions.
float importance(LightNode node, AirRay ray) {
  if (node.lower.x > node.upper.x) return 0.0;
  const vec3 extent = node.upper - node.lower;
  const float radius = 0.5 * length(extent);
  const vec3 centre = 0.5 * (node.lower + node.upper);
  const AirView view = air_seen_from(centre, ray, 0.25 * radius + MIN_RADIUS);
  // Air at the eye's end of the node; never none, because lights may shine far from where they are.
  const float to_eye = clamp(view.nearest - radius, 0.0, ray.depth);
  const float passed = exp(-min(FRAME.air.extinction * to_eye, 10.0));
  return node.flux_lm * passed * view.range / view.height * likely_seen(ray, centre, radius);
}

// Returns the weights of the four children of a node of a light BVH: that of the vehicles, or that
// of the static lights. The children start at `place` of the `count` nodes of their level; `first`
// is the level's place among all nodes.
float[4] weigh_children(bool vehicles, uint first, uint count, uint place, AirRay ray) {
  float weight[4];
  for (uint i = 0u; i < 4u; ++i) {
    weight[i] = 0.0;
    if (place + i >= count) continue;
    const uint at = first + place + i;
    if (vehicles) weight[i] = importance(FRAME.vehicle_nodes.at[at], ray);
    else weight[i] = importance(SCENE.light_tree.nodes.at[at], ray);
  }
  return weight;
}

// The same for a node of the static lights' BVH.
float[4] weigh_static_children(AirRay ray, uint level, uint place) {
  return weigh_children(false, SCENE.light_tree.level_first[level - 1u],
                        SCENE.light_tree.level_count[level - 1u], 4u * place, ray);
}

// Returns a static light for a ray, by descending their light BVH.
SampledLight sample_tree_light(AirRay ray) {
  SampledLight chosen = NO_LIGHT;
  float pdf = 1.0;
  uint place = 0u;
  for (uint level = SCENE.light_tree.levels - 1u; level > 0u; --level) {
    const uint child = sample_child(weigh_static_children(ray, level, place), pdf);
    if (child == 4u) return chosen;
    place = 4u * place + child;
  }
  chosen.index = SCENE.light_tree.nodes.at[place].item;
  chosen.light = light_at(chosen.index);
  chosen.pdf = pdf;
  return chosen;
}

// Returns the density of a static light among those of sample_tree_light().
float tree_density(AirRay ray, uint light) {
  float pdf = 1.0;
  uint place = SCENE.light_tree.leaf_of_light.at[light];
  for (uint level = 1u; level < SCENE.light_tree.levels; ++level) {
    const float weight[4] = weigh_static_children(ray, level, place >> 2u);
    const float sum = weight[0] + weight[1] + weight[2] + weight[3];
    if (!(sum > 0.0)) return 0.0;
    pdf *= weight[place & 3u] / sum;
    place >>= 2u;
  }
  return pdf;
}

// The share of the static candidates that are sampled from the light BVH. It knows which lights
// matter to the whole ray, and the map grids which of many lights are close to a place on it.
const float TREE_SHARE = 0.5;

// Returns a static light for a ray: by the light BVH, or for a place on the ray by the map grids;
// weighted by both, as in sample_static_light(). `technique` in [0, 1) chooses.
SampledLight sample_static_light_in_air(AirRay ray, float technique) {
  const LightSampler grids =
      light_sampler_at(ray.origin + ray.direction * (min(ray.depth, AIR_REACH) * random_float()));
  SampledLight chosen;
  float tree;
  if (technique < TREE_SHARE) {
    chosen = sample_tree_light(ray);
    tree = chosen.pdf;
    if (!(tree > 0.0)) return chosen;
  } else {
    chosen = sample_static_light(grids, (technique - TREE_SHARE) / (1.0 - TREE_SHARE));
    // A light that is off has no leaf.
    tree = chosen.light.flux_lm > 0.0 ? tree_density(ray, chosen.index) : 0.0;
  }
  chosen.pdf = TREE_SHARE * tree +
               (1.0 - TREE_SHARE) * static_density(grids, chosen.light);
  return chosen;
}

// The same of a vehicle's light.
SampledLight sample_vehicle_light(AirRay ray) {
  ray.origin = turn_to_boxes(ray.origin);
  ray.direction = turn_to_boxes(ray.direction);
  ray.normal = turn_to_boxes(ray.normal);
  float pdf = 1.0;
  uint place = 0u;
  for (uint level = SCENE.traffic.levels - 1u; level > 0u; --level) {
    const float weight[4] =
        weigh_children(true, SCENE.traffic.level_first[level - 1u],
                       SCENE.traffic.level_count[level - 1u], 4u * place, ray);
    const uint child = sample_child(weight, pdf);
    if (child == 4u) return NO_LIGHT;
    place = 4u * place + child;
  }
  return sample_light_of_vehicle(FRAME.vehicle_nodes.at[place], pdf);
}

// Returns one light for a ray. `technique` in [0, 1) chooses: below `share`, a vehicle's.
SampledLight sample_light_in_air(AirRay ray, float share, float technique) {
  SampledLight chosen = NO_LIGHT;
  if (technique < share) {
    chosen = sample_vehicle_light(ray);
    chosen.pdf *= share;
  } else if (SCENE.light_tree.levels > 0u) {
    chosen = sample_static_light_in_air(ray, (technique - share) / (1.0 - share));
    chosen.pdf *= 1.0 - share;
  }
  return chosen;
}
