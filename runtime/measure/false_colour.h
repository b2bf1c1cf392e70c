// Pictures of quantities: a value a pixel as a colour, on a logarithmic scale with a bar that says which
// colour is how much.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/measure/image.h"

namespace nightcity {

struct ColourScale {
  double lowest = 0.01,
         highest = 100;  // both above 0; values outside take the end's colour, 0 and less is black
  std::string unit;      // "cd/m2", "lx"
};

/// A scale of whole decades around the middle 98 % of the values above 0; at least one decade.
ColourScale fitting_scale(std::span<const float> values, std::string unit);

/// `values` row by row, row 0 on top, with a scale bar below the picture (height grows by scale_bar_height).
/// Dark to light as the values grow, in an order that survives printing in grey.
constexpr std::uint32_t scale_bar_height = 36;
Image8 false_colour(std::span<const float> values, std::uint32_t width, std::uint32_t height,
                    const ColourScale& scale);

/// Luminance of each pixel, cd/m2.
std::vector<float> luminance_of(const Image& image);

/// Illuminance of each pixel's surface, lux: pi times its reflected luminance over its albedo, channel by
/// channel, weighted as luminance is. From the layers direct_*, sky and albedo, which must be there, else
/// Error. 0 where nothing was hit or the surface is black. Of a matt surface: a wet one shines on top of what
/// lights it.
std::vector<float> illuminance_of(const Image& image);

}  // namespace nightcity
