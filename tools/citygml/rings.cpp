#include "tools/citygml/rings.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "tools/citygml/curves.h"
#include "tools/citygml/tag_scanner.h"
#include "tools/decimal.h"

namespace nightcity::citygml {
namespace {

bool parse_numbers(const char* at, const char* end, std::vector<double>& numbers) {
  for (;;) {
    while (at < end && is_space(*at)) ++at;
    if (at == end) return true;
    if (*at == '+') ++at;
    double value = 0;
    const auto [rest, error] = parse_decimal(at, end, value);
    if (error != std::errc() || !std::isfinite(value) || (rest < end && !is_space(*rest)))
      return false;
    numbers.push_back(value);
    at = rest;
  }
}

int dimension_of(const pugi::xml_node& element, int inherited) {
  const pugi::xml_attribute said = element.attribute("srsDimension");
  const int dimension = said ? std::atoi(said.value()) : inherited;
  return dimension == 2 ? 2 : 3;
}

bool append_vertices(const std::vector<double>& numbers, int dimension, city::Ring& ring) {
  const auto d = static_cast<std::size_t>(dimension);
  if (numbers.size() % d != 0) return false;
  ring.reserve(ring.size() + numbers.size() / d);
  for (std::size_t i = 0; i < numbers.size(); i += d) {
    const glm::dvec3 p{numbers[i], numbers[i + 1], d == 3 ? numbers[i + 2] : 0.0};
    if (ring.empty() || ring.back() != p) ring.push_back(p);
  }
  return true;
}

// GML 2's <coordinates>: "x,y,z x,y,z", with separators given by attributes.
RingFault read_coordinates(const pugi::xml_node& element, city::Ring& ring) {
  const auto said = [&](const char* name, char standard) {
    const char* value = element.attribute(name).value();
    return *value ? *value : standard;
  };
  const char decimal = said("decimal", '.'), within = said("cs", ','), between = said("ts", ' ');
  std::string text;
  for (const pugi::xml_node& part : element.children()) text += part.value();
  std::vector<double> numbers;
  std::size_t at = 0;
  const auto is_between = [&](char c) { return c == between || is_space(c); };
  while (at < text.size()) {
    while (at < text.size() && is_between(text[at])) ++at;
    std::size_t end = at;
    while (end < text.size() && !is_between(text[end])) ++end;
    if (end == at) break;
    std::string tuple = text.substr(at, end - at);
    for (char& c : tuple) c = c == within ? ' ' : c == decimal ? '.' : c;
    numbers.clear();
    if (!parse_numbers(tuple.data(), tuple.data() + tuple.size(), numbers))
      return RingFault::not_numbers;
    if (numbers.size() != 2 && numbers.size() != 3) return RingFault::wrong_count;
    append_vertices(numbers, static_cast<int>(numbers.size()), ring);
    at = end;
  }
  return RingFault::none;
}

}  // namespace

const char* name_of(RingFault fault) {
  switch (fault) {
    case RingFault::none:
      break;
    case RingFault::no_coordinates:
      return "ring without coordinates";
    case RingFault::not_numbers:
      return "ring with coordinates that are no numbers";
    case RingFault::wrong_count:
      return "ring with an incomplete vertex";
    case RingFault::too_short:
      return "ring of fewer than three vertices";
    case RingFault::unknown_curve:
      return "ring of curves that are not read (splines, arcs by centre, xlinks)";
  }
  return "sound ring";
}

bool read_numbers(const pugi::xml_node& element, std::vector<double>& numbers) {
  for (const pugi::xml_node& part : element.children()) {
    const char* text = part.value();
    if (!parse_numbers(text, text + std::strlen(text), numbers)) return false;
  }
  return true;
}

int find_dimension(const pugi::xml_node& element, int inherited) {
  const pugi::xml_attribute said = element.attribute("srsDimension");
  return said ? said.as_int() : inherited;
}

RingFault read_vertices(const pugi::xml_node& element, int dimension, city::Ring& vertices) {
  const int inherited = dimension_of(element, dimension);
  thread_local std::vector<double> numbers;  // allocated once per thread, not once per ring
  bool any = false;
  for (const pugi::xml_node& child : element.children()) {
    const std::string_view name = local_name(child.name());
    pugi::xml_node holder = child;
    if (name == "pointProperty" || name == "pointRep") holder = child.first_child().first_child();
    const std::string_view kind = local_name(holder.name());
    if (kind == "coordinates") {
      any = true;
      if (const RingFault fault = read_coordinates(holder, vertices); fault != RingFault::none)
        return fault;
    } else if (kind == "posList" || kind == "pos") {
      any = true;
      numbers.clear();
      if (!read_numbers(holder, numbers)) return RingFault::not_numbers;
      if (!append_vertices(numbers, dimension_of(holder, inherited), vertices))
        return RingFault::wrong_count;
    }
  }
  return any ? RingFault::none : RingFault::no_coordinates;
}

RingFault read_ring(const pugi::xml_node& linear_ring, int dimension, city::Ring& ring) {
  ring.clear();
  const bool of_curves = is_curve_ring(local_name(linear_ring.name()));
  const RingFault fault = of_curves ? read_curves(linear_ring, dimension, ring)
                                    : read_vertices(linear_ring, dimension, ring);
  if (fault != RingFault::none) return fault;
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
  return ring.size() < 3 ? RingFault::too_short : RingFault::none;
}

}  // namespace nightcity::citygml
