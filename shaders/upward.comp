#version 460
#extension GL_GOOGLE_include_directive : require
// How much of each light leaves the city upwards: an invocation a light (from push.first), push.count rays each, straight and off the
// first surface met, which reflects as its albedo has it. More bounces are left out: at a city's albedos they are a fifth of a fifth.
#define WORKGROUP_IS_A_ROW
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/surface_hit.glsl"
#include "shaders/lights.glsl"

void count_at(vec3 place, float lumen) {
  const vec2 at = floor((place.xz - vec2(FRAME.upward.origin_x, FRAME.upward.origin_z)) / FRAME.upward.cell_m);
  const vec2 last = vec2(FRAME.upward.width, FRAME.upward.depth) - 1.0;
  const uvec2 cell = uvec2(clamp(at, vec2(0.0), last));
  if (at != vec2(cell)) return;  // beside the map
  // Rounded up or down by chance, so that the sum is right whatever the rays carry.
  atomicAdd(FRAME.upward.cells.at[cell.y * FRAME.upward.width + cell.x], uint(lumen * 1024.0 + random_float()));
}

void main() {
  const uint index = push.first + INVOCATION.x;
  if (index >= SCENE.light_count) return;
  const Light light = light_at(index);
  if (!(light.flux_lm > 0.0)) return;
  random_state = pcg4d(uvec4(index, FRAME.frame, 77u, FRAME.seed)).w;
  const uvec2 start = uvec2(random_uint(), random_uint());
  const bool window = (light.kind_profile & 255u) == LIGHT_RECTANGLE;
  Escape sum = Escape(0.0, 0.0, 0.0);
  for (uint i = 0u; i < push.count; ++i) {
    // Stratified over the rays: the R2 sequence (Roberts 2018).
    const uvec2 at = start + (FRAME.frame * push.count + i) * uvec2(3242174889u, 2447445414u);
    const vec2 u = vec2(at >> 8u) * (1.0 / 16777216.0);
    vec3 origin = light.position, direction;
    float share = 1.0;  // of the light's flux, that this ray carries, times the number of rays
    if (window) {
      origin += light.tangent * (light.radius * (2.0 * random_float() - 1.0)) +
                cross(light.axis, light.tangent) * (light.half_height * (2.0 * random_float() - 1.0));
      direction = cosine_direction(light.axis, u);
      origin = offset_origin(origin, light.axis, 1.0);
    } else {
      const float height = 1.0 - 2.0 * u.x, radius = sqrt(max(1.0 - height * height, 0.0)), phi = 2.0 * PI * u.y;
      direction = vec3(radius * cos(phi), height, radius * sin(phi));
      share = 4.0 * PI * intensity_per_lumen(light, direction);
      if (!(share > 0.0)) continue;
    }
    // Straight, then off what it met: one call, so that the traversal is in the shader once.
    float albedo = 1.0;
    for (uint bounce = 0u; bounce < 2u; ++bounce) {
      Hit hit;
      if (!trace(origin, direction, bounce == 0u ? 0.0 : NEAREST_M, 1e30, MASK_SHADOW, false, hit)) {
        if (direction.y > 0.0) {
          if (bounce == 0u) sum.direct += share; else sum.reflected += share * albedo;
          count_at(origin, light.flux_lm * share * albedo / float(FRAME.upward.rays));
        } else if (bounce == 0u) {
          sum.sideways += share;
        }
        break;
      }
      const SurfaceHit hit_surface = surface_at(hit, SCENE.instances.at[hit.instance], direction);
      albedo = luminance(SCENE.materials.at[hit_surface.material].base_colour * light_colour(light.colour_rgb9e5));
      origin = offset_origin(origin + direction * hit.t, hit_surface.normal, hit.t);
      direction = cosine_direction(hit_surface.normal, vec2(random_float(), random_float()));
    }
  }
  Escape total = FRAME.upward.escapes.at[index];
  total.direct += sum.direct;
  total.reflected += sum.reflected;
  total.sideways += sum.sideways;
  FRAME.upward.escapes.at[index] = total;
}
