#version 460
#extension GL_GOOGLE_include_directive : require
// Writes the displayed pixel anew from a quantity of the picture, in false colours.
#include "shaders/common.glsl"
#include "shaders/accumulation.glsl"
#include "shaders/display.glsl"
#include "shaders/views.glsl.h"
#include "shaders/wire.glsl"

const int STOPS[3 * FALSE_COLOUR_STOPS] = int[](FALSE_COLOURS);
const int SIGNED_STOPS[3 * SIGNED_COLOUR_STOPS] = int[](SIGNED_COLOURS);

uint packed(vec3 rgb) {
  const uvec3 bytes = uvec3(clamp(rgb, vec3(0.0), vec3(255.0)) + 0.5);
  return bytes.r | bytes.g << 8 | bytes.b << 16 | 0xFF000000u;
}

// Returns the colour of a share of the scale, which has no value below 0.
vec3 colour_at(float share) {
  const float at = clamp(share, 0.0, 1.0) * float(FALSE_COLOUR_STOPS - 1);
  const int low = min(int(at), FALSE_COLOUR_STOPS - 2);
  vec3 colour;
  for (int c = 0; c < 3; ++c)
    colour[c] = mix(float(STOPS[3 * low + c]), float(STOPS[3 * low + 3 + c]), at - float(low));
  return colour;
}

// Returns the colour of a value on the logarithmic scale; 0, less and NaN are black.
vec3 colour_of(float value) {
  if (!(value > 0.0)) return vec3(0.0);
  return colour_at(log(value / FRAME.view_lowest) / log(FRAME.view_highest / FRAME.view_lowest));
}

// Returns the illuminance in lux of a matt surface that reflects this light, as
// measure::illuminance_of does.
float lux_of(uint index, vec3 reflected) {
  const Surface surface = FRAME.surfaces.at[index];
  if (surface.depth <= 0.0) return 0.0;
  const vec3 albedo = base_colour_of(surface.material);
  return luminance(mix(vec3(0.0), PI * reflected / max(albedo, vec3(1e-6)),
                       greaterThan(albedo, vec3(0.0))));
}

// Returns a colour for an index that differs from those of its neighbours.
vec3 colour_of_index(uint index) {
  uint h = index * 2654435769u;
  h = (h ^ h >> 15u) * 2246822519u;
  h ^= h >> 13u;
  return vec3(h & 255u, h >> 8u & 255u, h >> 16u & 255u) * 0.8 + 40.0;
}

vec3 kinds_at(uint index) {
  const LightLayers sum = FRAME.layers.at[index].sum;
  const float lamps = luminance(sum.lamps), windows = luminance(sum.windows),
              vehicles = luminance(sum.vehicles), sky = luminance(sum.sky),
              emitted = luminance(sum.emitted), indirect = luminance(sum.indirect);
  const float all = lamps + windows + vehicles + sky + emitted + indirect;
  if (!(all > 0.0)) return vec3(0.0);
  const vec3 mixed = lamps * vec3(KIND_COLOUR_LAMPS) + windows * vec3(KIND_COLOUR_WINDOWS) +
                     vehicles * vec3(KIND_COLOUR_VEHICLES) + sky * vec3(KIND_COLOUR_SKY) +
                     indirect * vec3(KIND_COLOUR_INDIRECT) + emitted * vec3(KIND_COLOUR_EMITTED);
  const float mean = luminance(mean_of(FRAME.accumulation.at[index]));
  return mixed / all * srgb_encode(tone_curve(FRAME.tone, mean * FRAME.exposure));
}

float noise_at(uint index) {
  const Accumulation total = FRAME.accumulation.at[index];
  if (total.frames < 2.0) return 0.0;
  const float mean = luminance(mean_of(total));
  const float variance = total.luminance_squared / total.frames - mean * mean;
  return mean > 0.0 ? sqrt(max(variance, 0.0) / (total.frames - 1.0)) / mean : 0.0;
}

// Returns the colour of a share of a signed scale, -1 .. 1.
vec3 signed_colour_at(float share) {
  const float at = clamp(share + 1.0, 0.0, 2.0);
  const int low = at < 1.0 ? 0 : 1;
  vec3 colour;
  for (int c = 0; c < 3; ++c)
    colour[c] = mix(float(SIGNED_STOPS[3 * low + c]), float(SIGNED_STOPS[3 * low + 3 + c]),
                    at - float(low));
  return colour;
}

// The reference may have another number of pixels: the nearest counts. Where both are dark, there
// is nothing to compare.
vec3 difference_at(uvec2 pixel, uint index) {
  const uvec2 size = FRAME.reference_size;
  const vec2 place = (vec2(pixel) + 0.5) / vec2(FRAME.size);
  const uvec2 at = min(uvec2(place * vec2(size)), size - 1u);
  const float reference = luminance(mean_of(FRAME.reference.at[at.y * size.x + at.x])),
              mean = luminance(mean_of(FRAME.accumulation.at[index]));
  if (reference > 0.0) return signed_colour_at((mean / reference - 1.0) / FRAME.view_highest);
  return mean > 0.0 ? signed_colour_at(1.0) : vec3(0.0);
}

vec3 bytes_of(uint shown) {
  return vec3(shown & 255u, shown >> 8u & 255u, shown >> 16u & 255u);
}

void main() {
  uvec2 pixel;
  uint index;
  if (!pixel_of_invocation(pixel, index)) return;
  const float frames = max(FRAME.accumulation.at[index].frames, 1.0);
  vec3 colour = vec3(0.0);
  switch (FRAME.view) {
    case VIEW_LUMINANCE:
      colour = colour_of(luminance(mean_of(FRAME.accumulation.at[index])));
      break;
    case VIEW_ILLUMINANCE:
    case VIEW_DIRECT:
    case VIEW_INDIRECT: {
      const LightLayers sum = FRAME.layers.at[index].sum;
      vec3 light = vec3(0.0);
      if (FRAME.view != VIEW_INDIRECT) light += sum.lamps + sum.windows + sum.vehicles + sum.sky;
      if (FRAME.view != VIEW_DIRECT) light += sum.indirect;
      colour = colour_of(lux_of(index, light / frames));
      break;
    }
    case VIEW_KINDS:
      colour = kinds_at(index);
      break;
    case VIEW_OBJECTS: {
      const Surface surface = FRAME.surfaces.at[index];
      if (surface.depth > 0.0)
        colour = surface.feature == NO_HIT ? vec3(50.0) : colour_of_index(surface.feature);
      break;
    }
    case VIEW_WIREFRAME:
      colour = mix(bytes_of(displayed(mean_of(FRAME.accumulation.at[index]))), vec3(WIRE_COLOUR),
                   wire_at(pixel));
      break;
    case VIEW_TILES: {
      const uint instance = FRAME.hits.at[2u * index + 1u];
      if (instance != NO_HIT)
        colour = colour_of_index(FRAME.hits.at[2u * index] / TILE_TRIANGLES + 1000003u * instance);
      break;
    }
    case VIEW_DIFFERENCE:
      colour = difference_at(pixel, index);
      break;
    case VIEW_HISTORY:
      // Without candidates there are no reservoirs.
      if (FRAME.candidates > 0u)
        colour = colour_of(FRAME.spatial.at[index].M / float(FRAME.candidates));
      break;
    case VIEW_NOISE:
      colour = colour_of(noise_at(index));
      break;
  }
  FRAME.display.at[index] = packed(colour);
}
