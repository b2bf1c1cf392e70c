#version 460
#extension GL_GOOGLE_include_directive : require
// Measures the flux of each light that leaves the city upwards: one invocation per light (from
// push.first), push.count rays each, followed straight and off the first surface they hit, which
// reflects diffusely. More bounces are left out: at a city's albedos of about a fifth, the second
// bounce adds a fifth of a fifth.
#define WORKGROUP_IS_A_ROW
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/surface_hit.glsl"
#include "shaders/lights.glsl"

void count_at(vec3 place, float lumen) {
  const vec2 at =
      floor((place.xz - vec2(FRAME.upward.origin_x, FRAME.upward.origin_z)) / FRAME.upward.cell_m);
  const vec2 last = vec2(FRAME.upward.width, FRAME.upward.depth) - 1.0;
  const uvec2 cell = uvec2(clamp(at, vec2(0.0), last));
  if (at != vec2(cell)) return;  // outside the map
  // Rounded up or down at random, so that the expected sum is right however little a ray carries.
  atomicAdd(FRAME.upward.cells.at[cell.y * FRAME.upward.width + cell.x],
            uint(lumen * 1024.0 + random_float()));
}

void main() {
  const uint index = push.first + INVOCATION.x;
  if (index >= SCENE.light_count) return;
  const Light light = light_at(index);
  if (!(light.flux_lm > 0.0)) return;
  seed_random_of_light(index, STREAM_UPWARD);
  const uvec2 start = uvec2(random_uint(), random_uint());
  Escape sum = Escape(0.0, 0.0, 0.0);
  for (uint i = 0u; i < push.count; ++i) {
    const EmittedRay ray = emit_ray(light, r2_point(start, FRAME.frame * push.count + i));
    if (!(ray.share > 0.0)) continue;
    vec3 origin = ray.origin, direction = ray.direction;
    // Straight, then off the surface it hit. One loop, so that the shader holds the traversal only
    // once.
    float albedo = 1.0;
    for (uint bounce = 0u; bounce < 2u; ++bounce) {
      Hit hit;
      if (!trace(origin, direction, 0.0, 1e30, MASK_SHADOW, false,
                 false, hit)) {
        if (direction.y > 0.0) {
          if (bounce == 0u) sum.direct += ray.share; else sum.reflected += ray.share * albedo;
          count_at(origin, light.flux_lm * ray.share * albedo / float(FRAME.upward.rays));
        } else if (bounce == 0u) {
          sum.sideways += ray.share;
        }
        break;
      }
      const SurfaceHit surface = surface_at(hit, SCENE.instances.at[hit.instance], origin, direction);
      albedo = luminance(SCENE.materials.at[surface.material].base_colour *
                         light_colour(light.colour_rgb9e5));
      origin = surface.position + surface.normal * surface.clearance;
      direction = cosine_direction(surface.normal, vec2(random_float(), random_float()));
    }
  }
  Escape total = FRAME.upward.escapes.at[index];
  total.direct += sum.direct;
  total.reflected += sum.reflected;
  total.sideways += sum.sideways;
  FRAME.upward.escapes.at[index] = total;
}
