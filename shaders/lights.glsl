// A point on a light, and what it sends to a receiver.
//
// A sample is (light, uv). The map from uv to a point is chosen per receiver: on a sphere uniformly in the cone it
// subtends, on a rectangle uniformly by area. Every estimator integrates over uv in [0, 1)^2, so reuse of a sample
// between pixels is the identity there and needs no Jacobian (primary sample space; GRIS, Lin et al. 2022).

const float MIN_RADIUS = 0.001;  // m: no lamp is smaller, so 1/d^2 has a physical bound at the lamp itself

struct LightSample {
  vec3 point;      // on the light
  vec3 direction;  // unit, receiver to point
  vec3 value;      // luminance * d(solid angle)/d(uv), cd/m^2 * sr per channel: illuminance on a facing surface
};

// Shared-exponent colour (EXT_texture_shared_exponent), scaled to luminance 1 so that flux stays photometric.
vec3 light_colour(uint packed) {
  const vec3 mantissa = vec3(packed & 511u, (packed >> 9u) & 511u, (packed >> 18u) & 511u);
  const vec3 rgb = mantissa * exp2(float(packed >> 27u) - 24.0);
  const float y = luminance(rgb);
  return y > 0.0 ? rgb / y : vec3(1.0);
}

bool is_lit(Words bits, uint light) { return (bits.at[light >> 5u] >> (light & 31u) & 1u) != 0u; }

// Light `index` as it shines in this frame, or in the one before; without flux where it does not. index < light_count.
Light light_at(uint index, bool before) {
  if (HAS_TRAFFIC != 0u && index >= SCENE.static_lights) {
    const uint moving = index - SCENE.static_lights;
    if (before) return FRAME.previous_vehicle_lights.at[moving];
    return FRAME.vehicle_lights.at[moving];
  }
  Light light = SCENE.lights.at[index];
  if (HAS_SCHEDULES != 0u && !is_lit(before ? FRAME.previous_lit : SCENE.lit, index)) light.flux_lm = 0.0;
  return light;
}

Light light_at(uint index) { return light_at(index, false); }

vec2 uv_of(uint packed) { return (vec2(packed & 0xFFFFu, packed >> 16u) + 0.5) * (1.0 / 65536.0); }

// Luminous intensity per lumen towards unit `to`, cd/lm: bilinear in the profile's (C, gamma) grid.
float intensity_per_lumen(Light light, vec3 to) {
  const uint profile_index = light.kind_profile >> 8u;
  if (HAS_PROFILES == 0u || profile_index == LIGHT_NO_PROFILE) return 1.0 / (4.0 * PI);
  const LightProfile profile = SCENE.profiles.at[profile_index];
  const vec3 side = cross(light.axis, light.tangent);
  const float angle = degrees(acos(clamp(dot(to, light.axis), -1.0, 1.0)));
  if (angle > profile.extent_deg) return 0.0;
  const float gamma = angle * (float(profile.gamma_count - 1u) / profile.extent_deg);
  const uint g0 = min(uint(gamma), profile.gamma_count - 2u);
  const float fg = gamma - float(g0);
  float turn = atan(dot(to, side), dot(to, light.tangent)) / (2.0 * PI);
  turn = (turn - floor(turn)) * float(profile.c_count);
  const uint c0 = min(uint(turn), profile.c_count - 1u);
  const uint c1 = c0 + 1u == profile.c_count ? 0u : c0 + 1u;
  const float fc = turn - float(c0);
  const uint row0 = profile.data_offset + c0 * profile.gamma_count + g0;
  const uint row1 = profile.data_offset + c1 * profile.gamma_count + g0;
  const float a = mix(SCENE.profile_data.at[row0], SCENE.profile_data.at[row0 + 1u], fg);
  const float b = mix(SCENE.profile_data.at[row1], SCENE.profile_data.at[row1 + 1u], fg);
  return mix(a, b, fc);
}

// Luminance of a lamp's or window's luminous surface seen along unit `to` (from the light), cd/m^2 per channel.
vec3 seen_luminance(Light light, vec3 to) {
  const vec3 colour = light_colour(light.colour_rgb9e5);
  if ((light.kind_profile & 255u) == LIGHT_RECTANGLE) {
    const float area = 4.0 * light.radius * light.half_height;
    return dot(light.axis, to) > 0.0 && area > 0.0 ? colour * light.flux_lm / (PI * area) : vec3(0.0);
  }
  const float radius = max(light.radius, MIN_RADIUS);
  return colour * light.flux_lm * intensity_per_lumen(light, to) / (PI * radius * radius);
}

LightSample sample_sphere(Light light, vec2 uv, vec3 receiver) {
  LightSample s;
  s.point = light.position;
  s.direction = vec3(0.0, 1.0, 0.0);
  s.value = vec3(0.0);
  const vec3 to_centre = light.position - receiver;
  const float radius = max(light.radius, MIN_RADIUS);
  const float d2 = dot(to_centre, to_centre);
  // Inside the lamp: its own globe, whose flat faces lie within the sphere, is not lit by it.
  if (d2 <= radius * radius) return s;
  const float d = sqrt(d2);
  const vec3 axis = to_centre / d;
  const float sin2_max = radius * radius / d2;
  const float cos_max = sqrt(max(1.0 - sin2_max, 0.0));
  // 1 - cos without cancellation for far lamps.
  const float one_minus_cos_max = sin2_max / (1.0 + cos_max);
  const float one_minus_cos = uv.x * one_minus_cos_max;
  const float cos_theta = 1.0 - one_minus_cos;
  const float sin2 = one_minus_cos * (2.0 - one_minus_cos);
  vec3 t, b;
  make_frame(axis, t, b);
  const float phi = 2.0 * PI * uv.y;
  s.direction = normalize(axis * cos_theta + (t * cos(phi) + b * sin(phi)) * sqrt(sin2));
  const float distance_to_point = d * cos_theta - sqrt(max(radius * radius - d2 * sin2, 0.0));
  s.point = receiver + s.direction * distance_to_point;
  // Luminance I / (pi r^2) times the cone's solid angle 2 pi (1 - cos): tends to I / d^2 as r tends to 0.
  const float per_candela = 2.0 / (d2 * (1.0 + cos_max));
  s.value = light_colour(light.colour_rgb9e5) * (light.flux_lm * intensity_per_lumen(light, -axis) * per_candela);
  return s;
}

LightSample sample_rectangle(Light light, vec2 uv, vec3 receiver) {
  LightSample s;
  const vec3 second = cross(light.axis, light.tangent);
  s.point = light.position + light.tangent * (light.radius * (2.0 * uv.x - 1.0)) +
            second * (light.half_height * (2.0 * uv.y - 1.0));
  const vec3 to_point = s.point - receiver;
  const float d2 = max(dot(to_point, to_point), MIN_RADIUS * MIN_RADIUS);
  s.direction = to_point * inversesqrt(d2);
  const float cos_light = -dot(s.direction, light.axis);
  // Luminance flux / (pi area), times area * cos / d^2: the area cancels, so a zero-area window is no hazard.
  s.value = cos_light > 0.0 ? light_colour(light.colour_rgb9e5) * (light.flux_lm * cos_light / (PI * d2)) : vec3(0.0);
  return s;
}

LightSample sample_point(Light light, vec2 uv, vec3 receiver) {
  if (HAS_RECTANGLES != 0u && (light.kind_profile & 255u) == LIGHT_RECTANGLE)
    return sample_rectangle(light, uv, receiver);
  return sample_sphere(light, uv, receiver);
}
