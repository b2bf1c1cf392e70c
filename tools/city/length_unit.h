// The names that files give to units of length.
#pragma once

#include <optional>
#include <string_view>

namespace nightcity::city {

/// Returns the metres in a unit by one of its names or codes, in lower case: "m", "feet", "метров",
/// "9002"; 1 for "". None where the word is unknown. This is the one table of them.
std::optional<double> find_metres_per_word(std::string_view word);

/// Returns the metres in a unit of length as files name it: "m", "ft", "urn:ogc:def:uom:UCUM::m",
/// "#cm", "US survey foot", "[m]", "meters above sea level"; 1 for "". None where the unit is
/// unknown.
std::optional<double> find_metres_per(std::string_view unit);

}  // namespace nightcity::city
