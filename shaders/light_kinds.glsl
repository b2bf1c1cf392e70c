// All code that depends on the kind of a light: one dispatch per operation. Everything
// else treats lights alike.
//
// A sample is (light, uv). The map from uv to a point is chosen per receiver: on a sphere uniformly
// in the cone it subtends, on a rectangle uniformly by area. Every estimator integrates over uv in
// [0, 1)^2, so reuse of a sample between pixels is the identity there and needs no Jacobian
// (primary sample space; GRIS, Lin et al. 2022).

#if LIGHT_KIND_COUNT != 2
#error "Each switch in shaders/light_kinds.glsl needs a case for the new kind of light."
#endif

// m: nothing nearer than this to a lamp is lit by it, so that 1/d^2 has a bound at a point.
const float MIN_RADIUS = 0.001;

struct LightSample {
  vec3 point;      // on the light
  vec3 direction;  // unit, from the receiver to the point
  // Luminance * d(solid angle)/d(uv), cd/m^2 * sr per channel: illuminance of a facing surface.
  vec3 value;
};

// Returns the kind of a light; the compiler knows it where the scene has no windows.
uint kind_here(Light light) { return HAS_RECTANGLES != 0u ? light_kind(light) : LIGHT_SPHERE; }

LightSample sample_sphere(Light light, vec2 uv, vec3 receiver) {
  LightSample s = LightSample(light.position, vec3(0.0, 1.0, 0.0), vec3(0.0));
  const vec3 to_centre = light.position - receiver;
  const float radius = max(light.radius, 0.0), nearest = max(radius, MIN_RADIUS);
  const float d2 = dot(to_centre, to_centre);
  // A point inside the lamp gets no light: the globe's own flat faces lie inside the sphere.
  if (d2 <= nearest * nearest) return s;
  const float per_d = inversesqrt(d2), d = d2 * per_d;
  const vec3 axis = to_centre * per_d;
  const float sin2_max = radius * radius / d2;
  const float cos_max = sqrt(max(1.0 - sin2_max, 0.0));
  // 1 - cos, without cancellation for far lamps.
  const float one_minus_cos_max = sin2_max / (1.0 + cos_max);
  const float one_minus_cos = uv.x * one_minus_cos_max;
  const float cos_theta = 1.0 - one_minus_cos;
  const float sin2 = one_minus_cos * (2.0 - one_minus_cos);
  vec3 t, b;
  make_frame(axis, t, b);
  const float phi = 2.0 * PI * uv.y;
  s.direction = axis * cos_theta + (t * cos(phi) + b * sin(phi)) * sqrt(sin2);
  const float distance_to_point = d * cos_theta - sqrt(max(radius * radius - d2 * sin2, 0.0));
  s.point = receiver + s.direction * distance_to_point;
  // Luminance I / (pi r^2) times the cone's solid angle 2 pi (1 - cos): tends to I / d^2 as r tends
  // to 0.
  const float per_candela = 2.0 / (d2 * (1.0 + cos_max));
  s.value = light_colour(light.colour_rgb9e5) *
            (light.flux_lm * intensity_per_lumen(light, -axis) * per_candela);
  return s;
}

// Below this solid angle, sr, sampling a rectangle by its area has as little noise, and the solid
// angle itself, a difference of angles, is known less well.
const float MIN_RECTANGLE_ANGLE = 0.02;

// Samples a rectangle uniformly in the solid angle that it subtends, as air needs it that touches a
// window: by area, its noise has no bound there. Returns false where the angle is too small or the
// receiver lies behind (Urena, Fajardo, King: An area-preserving parametrization for spherical
// rectangles, 2013; the names are theirs).
bool sample_rectangle_angle(Light light, vec2 uv, vec3 receiver, out LightSample s) {
  const vec3 second = cross(light.axis, light.tangent), way = light.position - receiver;
  const float z0 = dot(way, light.axis), half_x = half_width(light), half_y = light.half_height;
  if (!(z0 < 0.0)) return false;
  const float x = dot(way, light.tangent), y = dot(way, second);
  const float x0 = x - half_x, x1 = x + half_x, y0 = y - half_y, y1 = y + half_y;
  // Normals of the planes through the receiver and the edges, at y0, x1, y1 and x0.
  const float n0 = y0 * inversesqrt(z0 * z0 + y0 * y0), n1 = x1 * inversesqrt(z0 * z0 + x1 * x1),
              n2 = y1 * inversesqrt(z0 * z0 + y1 * y1), n3 = x0 * inversesqrt(z0 * z0 + x0 * x0);
  const float g0 = acos(n0 * n1), g1 = acos(-n1 * n2), g2 = acos(n2 * n3), g3 = acos(-n3 * n0);
  const float k = 2.0 * PI - g2 - g3, angle = g0 + g1 - k;
  if (!(angle > MIN_RECTANGLE_ANGLE)) return false;
  const float au = uv.x * angle + k, b0 = -n0, b1 = n2;
  const float fu = (cos(au) * b0 - b1) / sin(au);
  const float cu =
      clamp((fu > 0.0 ? 1.0 : -1.0) * inversesqrt(fu * fu + b0 * b0), -1.0, 1.0);
  const float xu = clamp(-cu * z0 * inversesqrt(max(1.0 - cu * cu, 1e-12)), x0, x1);
  const float d = sqrt(xu * xu + z0 * z0);
  const float h = mix(y0 * inversesqrt(d * d + y0 * y0), y1 * inversesqrt(d * d + y1 * y1), uv.y);
  const float yv = clamp(h * d * inversesqrt(max(1.0 - h * h, 1e-12)), y0, y1);
  const vec3 to_point = light.tangent * xu + second * yv + light.axis * z0;
  s.point = receiver + to_point;
  s.direction = normalize(to_point);
  s.value = light_colour(light.colour_rgb9e5) *
            (light.flux_lm * angle / (4.0 * PI * half_x * half_y));
  return true;
}

LightSample sample_rectangle(Light light, vec2 uv, vec3 receiver) {
  LightSample s;
  const vec3 second = cross(light.axis, light.tangent);
  s.point = light.position + light.tangent * (half_width(light) * (2.0 * uv.x - 1.0)) +
            second * (light.half_height * (2.0 * uv.y - 1.0));
  const vec3 to_point = s.point - receiver;
  const float d2 = max(dot(to_point, to_point), MIN_RADIUS * MIN_RADIUS);
  s.direction = to_point * inversesqrt(d2);
  const float cos_light = -dot(s.direction, light.axis);
  // Luminance flux / (pi area), times area * cos / d^2: the area cancels, so a zero-area window is
  // no hazard.
  s.value = cos_light > 0.0
                ? light_colour(light.colour_rgb9e5) * (light.flux_lm * cos_light / (PI * d2))
                : vec3(0.0);
  return s;
}

// Returns the point of a light that uv in [0, 1)^2 stands for, and what it would send to a receiver
// through clear air.
LightSample sample_in_clear_air(Light light, vec2 uv, vec3 receiver) {
  switch (kind_here(light)) {
    case LIGHT_SPHERE: return sample_sphere(light, uv, receiver);
    case LIGHT_RECTANGLE: return sample_rectangle(light, uv, receiver);
  }
  return LightSample(light.position, vec3(0.0, 1.0, 0.0), vec3(0.0));
}

// Returns the same point, and what it sends to a receiver through the scene's air.
LightSample sample_point(Light light, vec2 uv, vec3 receiver) {
  LightSample s = sample_in_clear_air(light, uv, receiver);
  s.value *= transmittance(s.point, receiver);
  return s;
}

// Returns the luminance of a light's emitting surface seen along unit `to`, which points away from
// the light; cd/m^2 per channel.
vec3 seen_luminance(Light light, vec3 to) {
  const vec3 colour = light_colour(light.colour_rgb9e5);
  switch (kind_here(light)) {
    case LIGHT_SPHERE: {
      const float radius = max(light.radius, MIN_RADIUS);
      return colour * light.flux_lm * intensity_per_lumen(light, to) / (PI * radius * radius);
    }
    case LIGHT_RECTANGLE: {
      const float area = 4.0 * half_width(light) * light.half_height;
      return dot(light.axis, to) > 0.0 && area > 0.0 ? colour * light.flux_lm / (PI * area)
                                                     : vec3(0.0);
    }
  }
  return vec3(0.0);
}

// Returns the square of the distance from a light's centre to its farthest point, m^2.
float bounding_radius2(Light light) {
  switch (kind_here(light)) {
    case LIGHT_SPHERE: return light.radius * light.radius;
    case LIGHT_RECTANGLE:
      return half_width(light) * half_width(light) + light.half_height * light.half_height;
  }
  return 0.0;
}

// A ray that carries some of a light's flux away from it.
struct EmittedRay {
  vec3 origin;
  vec3 direction;  // unit
  // A share of the light's flux, times the number of rays; 0 = the light is dark in this direction.
  float share;
};

// Returns a ray that leaves a light: its direction sampled from u in [0, 1)^2, uniformly from a
// sphere and by the cosine from a rectangle; its origin uniformly on what the light shows there.
EmittedRay emit_ray(Light light, vec2 u) {
  switch (kind_here(light)) {
    case LIGHT_SPHERE: {
      const float height = 1.0 - 2.0 * u.x, radius = sqrt(max(1.0 - height * height, 0.0)),
                  phi = 2.0 * PI * u.y;
      const vec3 direction = vec3(radius * cos(phi), height, radius * sin(phi));
      const float along2 = random_float(), turn = 2.0 * PI * random_float();
      vec3 t, b;
      make_frame(direction, t, b);
      const vec3 outwards =
          (t * cos(turn) + b * sin(turn)) * sqrt(1.0 - along2) + direction * sqrt(along2);
      return EmittedRay(light.position + outwards * max(light.radius, MIN_RADIUS), direction,
                        4.0 * PI * intensity_per_lumen(light, direction));
    }
    case LIGHT_RECTANGLE: {
      vec3 origin = light.position;
      origin +=
          light.tangent * (half_width(light) * (2.0 * random_float() - 1.0)) +
          cross(light.axis, light.tangent) * (light.half_height * (2.0 * random_float() - 1.0));
      return EmittedRay(origin + light.axis * clearance_of(origin, 0.0),
                        cosine_direction(light.axis, u), 1.0);
    }
  }
  return EmittedRay(light.position, vec3(0.0, 1.0, 0.0), 0.0);
}

// Returns the share that a ray from emit_ray() brings to a point on it: a sphere shines at a point
// close by as it does along the way from its centre.
float share_at(Light light, vec3 point) {
  switch (kind_here(light)) {
    case LIGHT_SPHERE: {
      const vec3 way = point - light.position;
      const float d2 = dot(way, way), radius = max(light.radius, MIN_RADIUS);
      // A point inside the lamp gets no light, as in sample_sphere().
      if (d2 <= radius * radius) return 0.0;
      return 4.0 * PI * intensity_per_lumen(light, way * inversesqrt(d2));
    }
    case LIGHT_RECTANGLE: return 1.0;
  }
  return 0.0;
}

// Adds the light of a static light to the layer of its kind.
void add_to_layer(inout LightLayers layers, Light light, vec3 direct) {
  switch (kind_here(light)) {
    case LIGHT_SPHERE: layers.lamps += direct; break;
    case LIGHT_RECTANGLE: layers.windows += direct; break;
  }
}
