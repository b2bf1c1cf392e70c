#version 460
#extension GL_GOOGLE_include_directive : require
// Half rate: gives each pixel that this frame has not sampled the mean light of the like surfaces
// beside it, divided by their reflectance and multiplied by its own.
#include "shaders/common.glsl"
#include "shaders/random.glsl"
#include "shaders/geometry.glsl"
#include "shaders/trace.glsl"
#include "shaders/camera.glsl"
#include "shaders/lights.glsl"
#include "shaders/shading.glsl"
#include "shaders/sky.glsl"
#include "shaders/reservoir.glsl"
#include "shaders/half_rate.glsl"
#include "shaders/accumulation.glsl"

// Light of a surface on its way to the eye: what passes, and what the sky adds on the way.
struct Way {
  float passed;
  vec3 airlight;
};

Way way_to(Surface surface, uvec2 pixel) {
  const float passed = transmittance(surface.position, FRAME.camera.position);
  return Way(passed, sky_airlight(camera_direction(pixel), passed));
}

void main() {
  const uvec2 pixel = pixel_of_colour(INVOCATION.x, INVOCATION.y, true);
  const uvec2 size = FRAME.size;
  if (!all(lessThan(pixel, size))) return;
  const uint index = pixel.y * size.x + pixel.x;
  if (!is_filled(FRAME.spatial.at[index])) return;
  const Surface surface = FRAME.surfaces.at[index];
  const Way way = way_to(surface, pixel);
  const vec3 reflectance = filling_reflectance(surface);
  vec3 sum = vec3(0.0);
  float found = 0.0;
  for (uint i = 0u; i < 4u; ++i) {
    const ivec2 at = ivec2(pixel) + BESIDE[i];
    if (!in_picture(at)) continue;
    const uint there = index_within(at, size);
    const Surface other = FRAME.surfaces.at[there];
    if (!may_fill(surface, other)) continue;
    const Way way_there = way_to(other, uvec2(at));
    const vec3 reflected = FRAME.radiance.at[there].sum - way_there.airlight;
    // Through air that lets next to nothing pass, both surfaces are hidden alike.
    const float clearer = way_there.passed > 1e-6 ? way.passed / way_there.passed : 1.0;
    sum += other.material == surface.material
               ? reflected * clearer
               : reflected * clearer * (reflectance / filling_reflectance(other));
    found += 1.0;
  }
  FRAME.radiance.at[index] = single_frame(sum / max(found, 1.0) + way.airlight);
}
