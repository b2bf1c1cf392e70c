// Attribute values as producers write them, into a CityObject's fields.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/city/city_model.h"

namespace nightcity {

/// Without white space at both ends.
std::string_view trimmed(std::string_view text);

/// A finite number with '.' as its decimal sign, whatever the locale; nothing else behind it but white space.
std::optional<double> parse_number(std::string_view text);

/// Sets the field that a standard attribute stands for. `name`: local name in lower case ("measuredheight").
/// False when the name stands for no field. Sentinels (9999, -9999 and the like) leave the field absent; of
/// repeated functions and usages all are kept, with ';' between.
bool set_attribute(CityObject& object, std::string_view name, std::string_view value);

}  // namespace nightcity
