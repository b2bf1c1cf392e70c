#include "tools/city/attributes.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "tools/city/length_unit.h"
#include "tools/city/plant_attributes.h"

namespace nightcity::city {
namespace {

void append(std::string& field, std::string_view value) {
  if (value.empty()) return;
  if (!field.empty()) field += ';';
  field += value;
}

void set_height(CityObject& object, std::string_view value, std::string_view unit) {
  constexpr double max_height_m = 5000;
  const auto metres = parse_length_m(value, unit);
  if (metres && *metres > 0 && *metres < max_height_m) object.measured_height_m = metres;
}

void set_storeys(CityObject& object, std::string_view value) {
  constexpr double max_storeys = 500;
  const auto storeys = parse_number(value);
  if (storeys && !is_sentinel(*storeys) && *storeys >= 0 && *storeys < max_storeys)
    object.storeys_above_ground = static_cast<int>(std::lround(*storeys));
}

void set_storey_heights(CityObject& object, std::string_view value, std::string_view unit) {
  constexpr double max_storey_m = 100;
  const double metres_per = find_metres_per(unit).value_or(1);
  while (!(value = trim(value)).empty()) {
    const auto end = std::min(value.find_first_of(" \t\r\n"), value.size());
    const auto height = parse_number(value.substr(0, end));
    const double metres = height.value_or(0) * metres_per;
    if (height && !is_sentinel(*height) && metres > 0 && metres < max_storey_m)
      object.storey_heights_m.push_back(metres);
    value.remove_prefix(end);
  }
}

}  // namespace

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::optional<double> parse_number(std::string_view text) {
  text = trim(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::optional<double> parse_measure(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == text.npos || text.find('.') != text.npos) return parse_number(text);
  std::string pointed(text);
  pointed[comma] = '.';
  return parse_number(pointed);
}

std::optional<double> parse_length_m(std::string_view value, std::string_view unit) {
  value = trim(value);
  auto length = parse_measure(value);
  // "9.5 m": a unit in the text is as good as one beside it.
  const std::size_t blank = value.find_last_of(' ');
  if (!length && blank != value.npos && find_metres_per(value.substr(blank + 1))) {
    length = parse_measure(value.substr(0, blank));
    unit = value.substr(blank + 1);
  }
  if (!length || is_sentinel(*length)) return {};
  return *length * find_metres_per(unit).value_or(1);
}

bool is_sentinel(double value) {
  const double v = std::abs(value);
  return v == 999 || v == 9999 || v == 99999 || v == 999999;
}

bool set_attribute(CityObject& object, std::string_view name, std::string_view value,
                   std::string_view unit) {
  value = trim(value);
  if (name == "function")
    append(object.function, value);
  else if (name == "usage")
    append(object.usage, value);
  else if (name == "class")
    append(object.building_class, value);
  else if (name == "measuredheight")
    set_height(object, value, unit);
  else if (name == "storeysaboveground")
    set_storeys(object, value);
  else if (name == "storeyheightsaboveground")
    set_storey_heights(object, value, unit);
  else if (name == "yearofconstruction" || name == "dateofconstruction")
    object.year = value.substr(0, 4);  // a year, or a date that begins with one
  else
    return false;
  return true;
}

void adopt_attributes(CityObject& whole, const CityObject& part) {
  if (whole.function.empty()) whole.function = part.function;
  if (whole.usage.empty()) whole.usage = part.usage;
  if (whole.building_class.empty()) whole.building_class = part.building_class;
  if (whole.address.empty()) whole.address = part.address;
  if (whole.year.empty()) whole.year = part.year;
  if (whole.storey_heights_m.empty()) whole.storey_heights_m = part.storey_heights_m;
  adopt_plant(whole.plant, part.plant);
  whole.measured_height_m = std::max(whole.measured_height_m, part.measured_height_m);
  whole.storeys_above_ground = std::max(whole.storeys_above_ground, part.storeys_above_ground);
}

std::string to_text(const Address& address) {
  const auto joined = [](const std::string& a, const std::string& between, const std::string& b) {
    return a.empty() || b.empty() ? a + b : a + between + b;
  };
  const std::string local = joined(joined(address.street, " ", address.number), ", ",
                                   joined(address.code, " ", address.place));
  return joined(local, ", ", address.country);
}

}  // namespace nightcity::city
