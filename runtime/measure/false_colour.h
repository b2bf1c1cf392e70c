// Pictures of quantities in false colours: one value per pixel, on a logarithmic scale with a
// labelled bar.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/measure/image.h"

namespace nightcity::measure {

struct ColourScale {
  double lowest = 0.01,
         highest =
             100;    // both above 0; values outside get the colour of that end, 0 and less black
  std::string unit;  // "cd/m2", "lx"
};

/// Returns the colour (8-bit sRGB) of a share of a scale, clamped to 0 .. 1: lightness rises evenly
/// from black over violet, red and orange to pale yellow.
std::array<std::uint8_t, 3> colour_at(double share);

/// Returns the colour (8-bit sRGB) of a share of a scale that goes from -1 over 0 to 1, to which it
/// is clamped: blue over grey to red.
std::array<std::uint8_t, 3> signed_colour_at(double share);

/// Returns a scale of whole decades, at least one, around the middle 98 % of the positive values.
ColourScale fitting_scale(std::span<const float> values, std::string unit);

/// Returns a picture of `values` (row by row, row 0 on top) with a scale bar below (its height
/// grows by scale_bar_height). Greater values are lighter, so the order survives printing in grey.
constexpr std::uint32_t scale_bar_height = 36;
Image8 false_colour(std::span<const float> values, std::uint32_t width, std::uint32_t height,
                    const ColourScale& scale);

/// Returns the luminance of each pixel in cd/m2.
std::vector<float> luminance_of(const Image& image);

/// The light that illuminance_of counts.
enum class Illumination {
  all,
  direct,   // straight from lights and sky
  indirect  // after a bounce at least
};

/// Returns the illuminance of each pixel's surface in lux: per channel, pi times the reflected
/// luminance over the albedo, weighted like luminance; 0 where nothing was hit or the surface is
/// black. It assumes a matt surface; a wet one also reflects specularly. Throws Error when the
/// layers direct_*, sky, indirect and albedo are missing.
std::vector<float> illuminance_of(const Image& image, Illumination part = Illumination::all);

}  // namespace nightcity::measure
