// Values of OSM tags as people write them: with units, typos, blanks and lists.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace nightcity::osm {

/// Returns the value in lower case, without blanks at the ends, and with underscores for the blanks
/// and hyphens inside: "High-Pressure Sodium " becomes "high_pressure_sodium".
std::string normalise_tag(std::string_view value);

/// Returns the parts of "a; b;c" without the blanks around them; empty parts are left out.
std::vector<std::string_view> split_list(std::string_view text);

/// Removes a number and the blanks around it from the front of `text` and returns it. A decimal
/// comma counts as a point. None, and `text` unchanged but for its blanks, where there is no finite
/// number.
std::optional<double> take_number(std::string_view& text);

/// Returns metres from "6", "6 m", "6,5", "20'", "12'6\"", "20 ft", "600 cm", "~6 m", the first of
/// "6;8" or the middle of "5-7"; none from what cannot be understood.
std::optional<double> parse_length_m(std::string_view text);

}  // namespace nightcity::osm
