#include "tools/osm/bearings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "tools/osm/tag_values.h"

namespace nightcity::osm {
namespace {

using std::string_view;

constexpr double turn = 360;

std::optional<double> find_compass_point(string_view word) {
  static const std::unordered_map<string_view, double> table{
      {"n", 0},          {"nne", 22.5},      {"ne", 45},         {"ene", 67.5},     {"e", 90},
      {"ese", 112.5},    {"se", 135},        {"sse", 157.5},     {"s", 180},        {"ssw", 202.5},
      {"sw", 225},       {"wsw", 247.5},     {"w", 270},         {"wnw", 292.5},    {"nw", 315},
      {"nnw", 337.5},    {"north", 0},       {"east", 90},       {"south", 180},    {"west", 270},
      {"northeast", 45}, {"southeast", 135}, {"southwest", 225}, {"northwest", 315}};
  std::string plain = normalise_tag(word);
  // "south-west" is a point; "s-w" is left to ranges.
  if (plain.size() > 5) std::erase(plain, '_');
  const auto found = table.find(plain);
  return found == table.end() ? std::nullopt : std::optional(found->second);
}

bool is_degree_sign(string_view unit) {
  constexpr std::array<string_view, 5> signs = {"", "\xc2\xb0", "deg", "degree", "degrees"};
  const std::string word = normalise_tag(unit);
  return std::find(signs.begin(), signs.end(), word) != signs.end();
}

// A number of degrees within a turn of north, not yet brought into 0 to 360.
std::optional<double> parse_degrees(string_view text) {
  const auto value = take_number(text);
  if (!value || !is_degree_sign(text) || *value < -turn || *value > turn) return std::nullopt;
  return value;
}

double within_a_turn(double degrees) {
  degrees = std::fmod(degrees, turn);
  return degrees < 0 ? degrees + turn : degrees;
}

// The middle of "45-100" and "NW-NE".
std::optional<double> parse_range(string_view text) {
  const std::size_t dash = text.find('-', 1);
  if (dash == string_view::npos) return std::nullopt;
  const string_view from = text.substr(0, dash), to = text.substr(dash + 1);
  constexpr double half_turn = 180;
  auto low = find_compass_point(from), high = find_compass_point(to);
  if (!low || !high) low = parse_degrees(from), high = parse_degrees(to);
  if (!low || !high) return std::nullopt;
  const double width = within_a_turn(*high - *low);
  return width > 0 && width < half_turn ? std::optional(within_a_turn(*low + width / 2))
                                        : std::nullopt;
}

bool is_digit_at(string_view text, std::size_t at) {
  return at < text.size() && text[at] >= '0' && text[at] <= '9';
}

// A comma between digits with exactly one digit behind it, and no other comma.
bool has_decimal_comma(string_view text) {
  const std::size_t comma = text.find(',');
  return comma != string_view::npos && comma > 0 && is_digit_at(text, comma - 1) &&
         is_digit_at(text, comma + 1) && !is_digit_at(text, comma + 2) &&
         text.find(',', comma + 1) == string_view::npos;
}

}  // namespace

std::optional<double> parse_bearing_degrees(string_view text) {
  const std::string plain = to_plain_signs(text);
  if (const auto point = find_compass_point(plain)) return point;
  if (const auto degrees = parse_degrees(plain)) return within_a_turn(*degrees);
  return parse_range(plain);
}

Bearings parse_bearings(string_view text) {
  std::string list;
  for (const string_view part : split_list(text)) {
    std::string plain(part);
    if (!has_decimal_comma(part)) std::replace(plain.begin(), plain.end(), ',', ';');
    for (char& c : plain)
      if (c == '/' || c == '|' || c == '&' || c == '+') c = ';';
    list += plain + ";";
  }
  Bearings out;
  for (const string_view part : split_list(list)) {
    if (const auto degrees = parse_bearing_degrees(part))
      out.degrees.push_back(*degrees);
    else
      out.unread.emplace_back(part);
  }
  return out;
}

}  // namespace nightcity::osm
