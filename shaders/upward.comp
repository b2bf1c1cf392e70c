#version 460
#extension GL_GOOGLE_include_directive : require
// Measures the flux of each light that leaves the city upwards: one invocation per light (from
// push.first), push.count rays each, followed straight and off up to FRAME.bounces surfaces, which
// reflect diffusely.
#define WORKGROUP_IS_A_ROW
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/surface_hit.glsl"
#include "shaders/lights.glsl"
#include "shaders/roulette.glsl"

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
    vec3 colour = light_colour(light.colour_rgb9e5);  // of luminance 1, then of what is left
    for (uint bounce = 0u; bounce <= FRAME.bounces; ++bounce) {
      Hit hit;
      if (!closest_hit(origin, direction, MASK_SHADOW, hit)) {
        if (direction.y > 0.0) {
          const float share = ray.share * luminance(colour);
          if (bounce == 0u) sum.direct += share; else sum.reflected += share;
          count_at(origin, light.flux_lm * share / float(FRAME.upward.rays));
        } else if (bounce == 0u) {
          sum.sideways += ray.share;
        }
        break;
      }
      const SurfaceHit surface =
          surface_at(hit, SCENE.instances.at[hit.instance], origin, direction, WIDE_SPREAD);
      colour *= base_colour_of(surface.material);
      // The first bounce is worth its ray even off a dark surface.
      if (bounce > 0u && !survives(colour)) break;
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
