// Turns attribute values as producers write them into a CityObject's fields.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/city/city_model.h"

namespace nightcity::city {

/// Returns `text` without white space at both ends.
std::string_view trim(std::string_view text);

/// Returns the finite number that `text` is, with '.' as its decimal sign whatever the locale; none
/// where anything but white space follows it.
std::optional<double> parse_number(std::string_view text);
/// The same of a text that may have a decimal comma, as some producers write attributes.
std::optional<double> parse_measure(std::string_view text);

/// Returns a length in m: a number, maybe with a decimal comma, and its unit beside it or behind it
/// ("9,5 m"). `unit`: beside it; one that is unknown stands for metres. None for sentinels.
std::optional<double> parse_length_m(std::string_view value, std::string_view unit);

/// Returns whether `value` is one that producers write where they mean "not known": 9999, 99999,
/// 999 and their negatives.
bool is_sentinel(double value);

/// Sets the field that a standard attribute stands for. `name`: local name in lower case
/// ("measuredheight"). Returns false when the name stands for no field. Sentinels (9999, -9999 and
/// the like) leave the field absent. Repeated functions and usages are all kept, with ';' between.
/// `unit`: that the file gives to a length; one that is unknown stands for metres.
bool set_attribute(CityObject& object, std::string_view name, std::string_view value,
                   std::string_view unit = {});

/// Takes over what a part says and its building does not. A building is as tall as its tallest
/// part.
void adopt_attributes(CityObject& whole, const CityObject& part);

/// Parts of an address; "" = absent.
struct Address {
  std::string street, number, code, place, country;
};
/// Returns "Street 12, 10115 Berlin, Germany", without what is absent.
std::string to_text(const Address& address);

}  // namespace nightcity::city
