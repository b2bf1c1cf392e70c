// Colours of lamps as linear Rec. 709 with luminance 1, so that flux stays photometric.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace nightcity {

/// Returns the CIE 1931 chromaticity (x, y) of a black body at a temperature in kelvin, by
/// Krystek's rational approximation of the Planckian locus (Color Res. Appl. 10, 1985). It is exact
/// to 1e-4 in (u, v) from 1000 to 15000 K; other temperatures are clamped to that range.
glm::dvec2 planckian_xy(double kelvin);

/// Returns linear Rec. 709 of luminance 1 for a chromaticity. Colours outside the gamut (sodium,
/// signal red) lose their negative channels. Mixing them with white instead would add blue to a
/// signal red, which would then look magenta where it is overexposed.
glm::vec3 rec709_from_xy(const glm::dvec2& xy);

/// Returns 0xRRGGBB (sRGB) as linear Rec. 709 of luminance 1; empty for black.
std::optional<glm::vec3> rec709_from_rgb(std::uint32_t rgb);

/// Returns "#rrggbb" or "#rgb" (sRGB) as linear Rec. 709 of luminance 1; empty for other texts and
/// for black.
std::optional<glm::vec3> rec709_from_hex(std::string_view text);

/// Returns the brightest "#rrggbb" of this chromaticity, the inverse of rec709_from_hex.
std::string to_hex(const glm::vec3& rec709);

}  // namespace nightcity
