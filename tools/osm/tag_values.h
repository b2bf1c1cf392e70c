// Values of OSM tags as people write them: with units, typos, blanks and lists.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/osm/osm_data.h"

namespace nightcity::osm {

/// Returns the value in lower case, without blanks at the ends, and with underscores for the blanks
/// and hyphens inside: "High-Pressure Sodium " becomes "high_pressure_sodium".
std::string normalise_tag(std::string_view value);

/// Returns the value of a tag as it is written, and the same normalised; "" where there is none.
const std::string& find_raw_tag(const OsmTags& tags, const std::string& key);
std::string find_tag(const OsmTags& tags, const std::string& key);
/// Returns whether a tag has a value, and not "no".
bool is_tagged(const OsmTags& tags, const std::string& key);

/// Returns the parts of "a; b;c" without the blanks around them; empty parts are left out.
std::vector<std::string_view> split_list(std::string_view text);

/// Removes a number and the blanks around it from the front of `text` and returns it. A decimal
/// comma counts as a point. None, and `text` unchanged but for its blanks, where there is no finite
/// number.
std::optional<double> take_number(std::string_view& text);

/// As take_number, of an amount whose thousands may be separated by comma, point, blank or
/// apostrophe. A single comma or point before three digits separates decimals where the number is
/// `least` or more so: with 100, "12,000" and "12.000" are 12000, and "850.125" is 850.125.
std::optional<double> take_amount(std::string_view& text, double least);

/// Takes "2 x" off the front of "2 x 36 W" and returns 2, at most 12; 1 where there is none.
double take_factor(std::string_view& text);

/// Returns lumens from "4500", "4500 lm", "12,000 lm" or "4.5 klm", and watts from "70 W", "1,000
/// W", "0.07 kW" or, those of all tubes, "2x36 W": no street lamp has 12 lm or 1 W, so that such a
/// number is of thousands. None from other units.
std::optional<double> parse_lumens(std::string_view text);
std::optional<double> parse_watts(std::string_view text);

/// Returns the text with the signs of ASCII for those of typography: no-break blanks, primes,
/// dashes, the minus, wide letters and digits, and the sign of what is about equal, which becomes
/// '~'; without marks that nobody sees.
std::string to_plain_signs(std::string_view text);

/// Returns metres from "6", "6 m", "6,5", "20'", "12'6\"", "20 ft", "12 ft 6 in", "600 cm", "~6 m",
/// "approx. 6 m", "6 m (20 ft)", the first of "6;8" or the middle of "5-7"; none from what cannot
/// be understood.
std::optional<double> parse_length_m(std::string_view text);

/// Returns the length that the first of these tags says from `least_m` to `greatest_m`, m.
std::optional<double> find_length_m(const OsmTags& tags, std::initializer_list<const char*> keys,
                                    double least_m, double greatest_m);

}  // namespace nightcity::osm
