#include "tools/inventory/degrees_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "tools/city/attributes.h"
#include "tools/osm/tag_values.h"

namespace nightcity::inventory {
namespace {

// In ASCII, with 'd' for the signs of degrees, and two primes as seconds.
std::string to_plain(std::string_view text) {
  std::string plain = osm::to_plain_signs(text), out;
  constexpr std::array<std::string_view, 3> degrees{"\xc2\xb0", "\xc2\xba", "\xcb\x9a"};
  for (std::size_t i = 0; i < plain.size();) {
    const std::string_view rest = std::string_view(plain).substr(i);
    const auto sign = std::find_if(degrees.begin(), degrees.end(),
                                   [&](std::string_view s) { return rest.starts_with(s); });
    if (sign != degrees.end()) {
      out += 'd';
      i += sign->size();
    } else if (rest.starts_with("''")) {
      out += '"';
      i += 2;
    } else {
      out += plain[i++];
    }
  }
  return out;
}

Angle::Axis axis_of(char letter) {
  switch (letter) {
    case 'N':
    case 'S':
    case 'n':  // but not 's', which stands for seconds
      return Angle::Axis::latitude;
    case 'E':
    case 'W':
    case 'e':
    case 'w':
      return Angle::Axis::longitude;
    default:
      return Angle::Axis::unknown;
  }
}

// Removes a number without a sign, with a point or a comma before its decimals.
std::optional<double> take_unsigned(std::string_view& text, bool& is_whole) {
  if (text.empty() || text.front() < '0' || text.front() > '9') return std::nullopt;
  const std::size_t before = text.size();
  std::string_view number = text;
  const auto value = osm::take_number(number);
  is_whole = text.substr(0, before - number.size()).find_first_of(".,") == std::string_view::npos;
  text = number;
  return value;
}

}  // namespace

std::optional<Angle> parse_angle(std::string_view text) {
  const std::string plain = to_plain(text);
  std::string_view rest = city::trim(plain);
  Angle angle;
  double sign = 1;
  const auto take_letter = [&](char letter) {
    angle.axis = axis_of(letter);
    if (letter == 'S' || letter == 'W' || letter == 'w') sign = -1;
  };
  if (rest.empty()) return std::nullopt;
  if (axis_of(rest.front()) != Angle::Axis::unknown) {
    take_letter(rest.front());
    rest = city::trim(rest.substr(1));
  } else if (axis_of(rest.back()) != Angle::Axis::unknown) {
    take_letter(rest.back());
    rest = city::trim(rest.substr(0, rest.size() - 1));
  }
  if (!rest.empty() && (rest.front() == '-' || rest.front() == '+')) {
    if (angle.axis != Angle::Axis::unknown) return std::nullopt;
    if (rest.front() == '-') sign = -1;
    rest.remove_prefix(1);
  }
  // Each part has its sign, a colon or a blank behind it.
  constexpr std::array<std::string_view, 3> signs{"d:", "':m", "\"s"};
  constexpr std::array<double, 3> parts{1, 60, 3600};
  bool is_whole = true;
  std::size_t n = 0;
  for (; n < parts.size() && !rest.empty(); ++n) {
    if (!is_whole) return std::nullopt;  // decimals before a smaller part
    const auto value = take_unsigned(rest, is_whole);
    if (!value || (n > 0 && *value >= 60)) return std::nullopt;
    angle.degrees += *value / parts[n];
    if (rest.starts_with("deg") && n == 0)
      rest.remove_prefix(3);
    else if (!rest.empty() && signs[n].find(rest.front()) != std::string_view::npos)
      rest.remove_prefix(1);
    rest = city::trim(rest);
  }
  if (n == 0 || !rest.empty()) return std::nullopt;
  const double most = angle.axis == Angle::Axis::latitude ? 90 : 360;
  if (!(angle.degrees <= most)) return std::nullopt;
  angle.degrees *= sign;
  return angle;
}

std::optional<glm::dvec2> parse_lat_lon(std::string_view text) {
  constexpr std::string_view around = " \t()[]";
  // Socrata writes the address first: "1 Main St\nChicago\n(41.88, -87.63)".
  if (const std::size_t bracket = text.rfind('(');
      bracket != text.npos && city::trim(text).ends_with(')'))
    text.remove_prefix(bracket);
  while (!text.empty() && around.find(text.front()) != around.npos) text.remove_prefix(1);
  while (!text.empty() && around.find(text.back()) != around.npos) text.remove_suffix(1);
  // Two angles with something between them: at a comma or semicolon, else behind a letter.
  const auto pair = [](std::string_view a, std::string_view b) -> std::optional<glm::dvec2> {
    const auto first = parse_angle(a), second = parse_angle(b);
    if (!first || !second) return std::nullopt;
    const bool turned =
        first->axis == Angle::Axis::longitude || second->axis == Angle::Axis::latitude;
    if (first->axis == second->axis && first->axis != Angle::Axis::unknown) return std::nullopt;
    return turned ? glm::dvec2(first->degrees, second->degrees)
                  : glm::dvec2(second->degrees, first->degrees);
  };
  for (const char separator : {';', '/', ','})  // decimal commas too are tried
    for (std::size_t at = text.find(separator); at != std::string_view::npos;
         at = text.find(separator, at + 1))
      if (const auto place = pair(text.substr(0, at), text.substr(at + 1))) return place;
  for (std::size_t at = 1; at + 1 < text.size(); ++at) {
    if (axis_of(text[at]) == Angle::Axis::unknown) continue;
    if (const auto place = pair(text.substr(0, at + 1), text.substr(at + 1))) return place;
    if (const auto place = pair(text.substr(0, at), text.substr(at))) return place;
  }
  return std::nullopt;
}

}  // namespace nightcity::inventory
