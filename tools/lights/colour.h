// Colours of lamps as linear Rec. 709 with luminance 1, so that flux stays photometric.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string_view>

namespace nightcity {

/// CIE 1931 chromaticity (x, y) of a black body. Krystek's rational approximation of the Planckian locus
/// (Color Res. Appl. 10, 1985), good to 1e-4 in (u, v) from 1000 to 15000 K; temperatures outside are clamped
/// to that range.
glm::dvec2 planckian_xy(double kelvin);

/// Linear Rec. 709 of luminance 1 for a chromaticity. Colours outside the gamut (sodium, signal red) lose
/// their negative channels. Mixed with white instead, a signal red would have blue, and shine magenta where
/// exposed beyond white.
glm::vec3 rec709_from_xy(const glm::dvec2& xy);

/// "#rrggbb" (sRGB) as linear Rec. 709 of luminance 1; nothing for another text or black.
std::optional<glm::vec3> rec709_from_hex(std::string_view text);

}  // namespace nightcity
