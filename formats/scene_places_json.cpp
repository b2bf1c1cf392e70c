#include "formats/scene_places_json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "formats/error.h"

namespace nightcity {
namespace {

using nlohmann::json;

// Coordinates of streets are told to a decimetre, and lie within a light's reach of the origin.
constexpr double steps_a_metre = 10, max_street_coordinate_m = 1e6;

bool is_within_bounds(const glm::dvec2& p) {
  return std::abs(p.x) <= max_street_coordinate_m && std::abs(p.y) <= max_street_coordinate_m;
}

std::vector<double> round_line(const std::vector<glm::dvec2>& line) {
  std::vector<double> numbers;
  for (const glm::dvec2& p : line) {
    if (!is_within_bounds(p)) throw Error("", "street", "a place is beyond 1e6 m of the origin");
    for (const double coordinate : {p.x, p.y})
      numbers.push_back(std::round(coordinate * steps_a_metre) / steps_a_metre);
  }
  return numbers;
}

json to_json(const NamedStreet& street) {
  if (!is_street_name(street.name)) throw Error("", "street", "the name is none");
  json lines = json::array();
  for (const auto& line : street.lines) lines.push_back(round_line(line));
  json object{{"name", street.name}, {"lines", lines}};
  if (street.also.empty()) return object;
  if (street.also.size() > max_other_names ||
      !std::all_of(street.also.begin(), street.also.end(), is_street_name))
    throw Error("", "street", "its other names are none, or too many");
  object["also"] = street.also;
  return object;
}

json to_json(const GeographicFit& fit) {
  if (const std::string fault = describe_fault(fit); !fault.empty())
    throw Error("", "latitude and longitude", fault);
  return {{"low", {fit.low.x, fit.low.y}},
          {"high", {fit.high.x, fit.high.y}},
          {"terms", fit.terms},
          {"latitude", fit.latitude},
          {"longitude", fit.longitude}};
}

// Returns the numbers of an array; an empty vector where it is none, or holds anything else.
std::vector<double> read_numbers(const json& object, const char* key) {
  const auto array = object.find(key);
  std::vector<double> numbers;
  if (array == object.end() || !array->is_array()) return numbers;
  for (const json& value : *array) {
    if (!value.is_number()) return {};
    numbers.push_back(value.get<double>());
  }
  return numbers;
}

GeographicFit read_fit(const json& object) {
  GeographicFit fit;
  const std::vector<double> low = read_numbers(object, "low"), high = read_numbers(object, "high");
  if (low.size() == 2 && high.size() == 2) {
    fit.low = {low[0], low[1]};
    fit.high = {high[0], high[1]};
  }
  if (const auto terms = object.find("terms"); terms != object.end() && terms->is_number_unsigned())
    fit.terms = terms->get<std::size_t>();
  fit.latitude = read_numbers(object, "latitude");
  fit.longitude = read_numbers(object, "longitude");
  return fit;
}

// Returns the other names of a street; none where one of them is unsound, since it has a name.
std::vector<std::string> read_other_names(const json& object) {
  std::vector<std::string> names;
  const auto also = object.find("also");
  if (also == object.end() || !also->is_array() || also->size() > max_other_names) return names;
  for (const json& name : *also) {
    if (!name.is_string() || !is_street_name(name.get<std::string>())) return {};
    names.push_back(name.get<std::string>());
  }
  return names;
}

// Returns nothing where the street is not as SPEC.md has it.
std::optional<NamedStreet> read_street(const json& object) {
  NamedStreet street;
  if (!object.is_object()) return std::nullopt;
  const auto name = object.find("name"), lines = object.find("lines");
  if (name == object.end() || !name->is_string() || lines == object.end() || !lines->is_array())
    return std::nullopt;
  street.name = name->get<std::string>();
  for (const json& line : *lines) {
    if (!line.is_array() || line.empty() || line.size() % 2 != 0) return std::nullopt;
    std::vector<glm::dvec2>& points = street.lines.emplace_back();
    for (std::size_t i = 0; i < line.size(); i += 2) {
      if (!line[i].is_number() || !line[i + 1].is_number()) return std::nullopt;
      points.emplace_back(line[i].get<double>(), line[i + 1].get<double>());
      if (!is_within_bounds(points.back())) return std::nullopt;
    }
  }
  if (!is_street_name(street.name) || street.lines.empty()) return std::nullopt;
  street.also = read_other_names(object);
  return street;
}

std::size_t count_points(const NamedStreet& street) {
  std::size_t points = 0;
  for (const auto& line : street.lines) points += line.size();
  return points;
}

std::vector<NamedStreet> read_streets(const json& array, std::vector<std::string>& skipped) {
  std::vector<NamedStreet> streets;
  if (!array.is_array()) {
    skipped.push_back("names of streets are left out: they are no list");
    return streets;
  }
  std::size_t left_out = 0, points = 0;
  for (const json& object : array) {
    std::optional<NamedStreet> street = read_street(object);
    if (street && (points += count_points(*street)) <= max_street_points)
      streets.push_back(std::move(*street));
    else
      ++left_out;
  }
  if (left_out > 0)
    skipped.push_back(
        std::to_string(left_out) +
        (left_out == 1 ? " name of a street is" : " names of streets are") +
        " left out: no name, no line, a place beyond 1e6 m, or over 1,000,000 points");
  return streets;
}

}  // namespace

bool is_street_name(const std::string& name) {
  return !name.empty() && name.size() <= max_street_name_bytes &&
         std::none_of(name.begin(), name.end(),
                      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
}

void add_to_json(const ScenePlaces& places, json& extras) {
  if (places.geographic) extras["geographic"] = to_json(*places.geographic);
  std::size_t points = 0;
  for (const NamedStreet& street : places.streets) {
    if ((points += count_points(street)) > max_street_points)
      throw Error("", "streets", "they have over 1,000,000 points");
    extras["streets"].push_back(to_json(street));
  }
}

ScenePlaces places_from_json(const json& extras, std::vector<std::string>& skipped) {
  ScenePlaces places;
  if (const auto geographic = extras.find("geographic"); geographic != extras.end()) {
    const std::string fault = geographic->is_object()
                                  ? describe_fault(places.geographic.emplace(read_fit(*geographic)))
                                  : "they are no object";
    if (!fault.empty()) {
      places.geographic.reset();
      skipped.push_back("latitude and longitude are left out: " + fault);
    }
  }
  if (const auto streets = extras.find("streets"); streets != extras.end())
    places.streets = read_streets(*streets, skipped);
  return places;
}

}  // namespace nightcity
