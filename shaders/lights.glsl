// Lights as they shine in a frame, and the parts of them that no kind of light has to itself.

// Returns a shared-exponent colour (EXT_texture_shared_exponent) as linear Rec. 709 of luminance 1,
// so that flux stays photometric.
vec3 light_colour(uint packed) {
  // The exponent is the same for all channels, and so does not matter.
  const vec3 rgb = vec3(packed & 511u, (packed >> 9u) & 511u, (packed >> 18u) & 511u);
  const float y = luminance(rgb);
  return y > 0.0 ? rgb * (1.0 / y) : vec3(1.0);
}

bool is_lit(Words bits, uint light) { return (bits.at[light >> 5u] >> (light & 31u) & 1u) != 0u; }

// Returns light `index` (below light_count) as it shines in this frame or, with `before`, in the
// frame before. Its flux is 0 while it is switched off.
Light light_at(uint index, bool before) {
  // Mesa's CPU driver also loads for lanes that have left a loop, whose index may be anything.
  index = min(index, SCENE.light_count - 1u);
  if (HAS_TRAFFIC != 0u && index >= SCENE.static_lights) {
    const uint moving = index - SCENE.static_lights;
    if (before) return FRAME.previous_vehicle_lights.at[moving];
    return FRAME.vehicle_lights.at[moving];
  }
  Light light = SCENE.lights.at[index];
  if (HAS_SCHEDULES != 0u && !is_lit(before ? FRAME.previous_lit : SCENE.lit, index))
    light.flux_lm = 0.0;
  return light;
}

Light light_at(uint index) { return light_at(index, false); }

// Returns static light `index` from a table of those that shine now. There is one at least.
Light shining_light_at(uint index) {
  return SCENE.lights.at[min(index, max(SCENE.static_lights, 1u) - 1u)];
}

// Unpacks a reservoir's uv.
vec2 uv_of(uint packed) {
  return (vec2(whole_to_float(packed & 0xFFFFu), whole_to_float(packed >> 16u)) + 0.5) *
         (1.0 / 65536.0);
}

// Returns a light's luminous intensity per lumen towards unit `to`, cd/lm: bilinear in its
// profile's (C, gamma) grid, and isotropic without a profile.
float intensity_per_lumen(Light light, vec3 to) {
  const uint profile_index = light_profile(light);
  if (HAS_PROFILES == 0u || profile_index == LIGHT_NO_PROFILE) return 1.0 / (4.0 * PI);
  const LightProfile profile = SCENE.profiles.at[profile_index];
  const vec3 local = vec3(dot(to, light.tangent), dot(to, cross(light.axis, light.tangent)),
                          dot(to, light.axis));
  // acos of a float cannot tell angles below 0.02 degrees apart; beams may be narrower.
  const float angle = 360.0 * turns_to(length(local.xy), local.z);
  if (angle > profile.extent_deg) return 0.0;
  const uint last = profile.gamma_count - 1u;
  float fg, fc;
  uint g0 = split_whole(angle * (whole_to_float(last) / profile.extent_deg), fg);
  if (g0 >= last) g0 = last - 1u, fg = 1.0;
  uint c0 = split_whole(turns_to(local.y, local.x) * whole_to_float(profile.c_count), fc);
  if (c0 >= profile.c_count) c0 = 0u;  // a whole turn
  const uint c1 = c0 + 1u == profile.c_count ? 0u : c0 + 1u;
  const uint row0 = profile.data_offset + c0 * profile.gamma_count + g0;
  const uint row1 = profile.data_offset + c1 * profile.gamma_count + g0;
  const float a = mix(SCENE.profile_data.at[row0], SCENE.profile_data.at[row0 + 1u], fg);
  const float b = mix(SCENE.profile_data.at[row1], SCENE.profile_data.at[row1 + 1u], fg);
  return mix(a, b, fc);
}

#include "shaders/air.glsl"
#include "shaders/light_kinds.glsl"
