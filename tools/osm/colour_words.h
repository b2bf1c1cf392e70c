// Colours as maps write them.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace nightcity::osm {

/// Returns the first of a list of colours as 0xRRGGBB in sRGB: a name of CSS (Color Module Level 4,
/// section 6.1; blanks, dashes and case do not matter), "cream" or "anthracite", "#abc", "#aabbcc"
/// with or without its sign and an opacity, which is not used, or "rgb(170, 187, 204)". Empty for
/// other texts.
std::optional<std::uint32_t> parse_colour(std::string_view text);

}  // namespace nightcity::osm
