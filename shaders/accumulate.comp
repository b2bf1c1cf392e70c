#version 460
#extension GL_GOOGLE_include_directive : require
// Adds the frame's estimate to the running mean, and writes the displayed pixel.
#include "shaders/common.glsl"
#include "shaders/geometry.glsl"
#include "shaders/half_rate.glsl"
#include "shaders/similar.glsl"
#include "shaders/accumulation.glsl"
#include "shaders/display.glsl"
#include "shaders/blocks.glsl"

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  vec3 radiance = FRAME.radiance.at[index].sum;
  for (uint slice = 1u; slice < FRAME.slices; ++slice)
    radiance += FRAME.radiance.at[slice * pixels_of_picture() + index].sum;
  // The last guard: no NaN or Inf reaches a pixel, and none stays in a sum.
  if (!all_finite(radiance)) radiance = vec3(0.0);
  if (luminance(radiance) > DARK_RANGE * FRAME.faint_luminance)
    FRAME.blocks.at[block_of(pixel)].is_lit = 1u;

  Accumulation total = NO_ACCUMULATION;
  if (FRAME.window == 0u) {
    if (FRAME.reset == 0u) total = FRAME.previous_accumulation.at[index];
  } else {
    // The mean moves with its surface. A surface that was not visible in the frame before starts a
    // new mean.
    const Surface surface = FRAME.surfaces.at[index];
    uint before = index;
    // The sizes come first: a picture that grew has more pixels than its history.
    const bool sky = FRAME.has_history != 0u && FRAME.previous_size == FRAME.size &&
                     surface.depth <= 0.0 && FRAME.previous_surfaces.at[index].depth <= 0.0;
    if (sky || previous_pixel(surface, before))
      total = FRAME.previous_accumulation.at[before];
    const float most = float(FRAME.window - 1u);
    if (total.frames > most) {
      const float share = most / total.frames;
      total = Accumulation(total.sum * share, most, total.compensation * share,
                           total.luminance_squared * share);
    }
  }
  // Filled light stands in until the pixel has light of its own, and goes when that comes: so the
  // mean of frames at rest has none of it.
  const bool filled = FRAME.half_rate != 0u && is_filled(FRAME.spatial.at[index]);
  if (!filled || total.frames < 1.0) {
    if (total.frames < 1.0) total = NO_ACCUMULATION;
    const float weight = filled ? STAND_IN : 1.0;
    add_compensated(total, weight * radiance);
    total.frames += weight;
    total.luminance_squared += weight * luminance(radiance) * luminance(radiance);
  }
  FRAME.accumulation.at[index] = total;

  FRAME.display.at[index] = displayed(total.sum / total.frames);
}
