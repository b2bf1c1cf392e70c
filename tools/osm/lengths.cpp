// Lengths as people write them.
#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "tools/city/length_unit.h"
#include "tools/osm/tag_values.h"

namespace nightcity::osm {
namespace {

using std::string_view;

// Removes the words and signs that say that a length is about right.
void skip_about(string_view& text) {
  constexpr std::array<string_view, 24> words = {
      "~",        "<",        ">",     "+",      "approximately",
      "approx.",  "approx",   "about", "around", "circa",
      "ca.",      "c.",       "約",    "约",     "aprox.",
      "cerca de", "environ",  "env.",  "etwa",   "około",
      "ok.",      "ongeveer", "W=",    "w="};
  for (bool found = true; found;) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    found = false;
    for (const string_view word : words)
      if (text.starts_with(word)) {
        text.remove_prefix(word.size());
        found = true;
        break;
      }
  }
}

// Returns a unit without a remark in brackets behind it: "m (39 ft)".
string_view drop_remark(string_view unit) {
  const std::size_t bracket = unit.find('(');
  return bracket != unit.npos && unit.ends_with(')') ? unit.substr(0, bracket) : unit;
}

constexpr double foot_m = 0.3048, inch_m = 0.0254;

std::optional<double> find_metres_per(string_view unit) {
  if (unit.ends_with('.')) unit.remove_suffix(1);
  return city::find_metres_per_word(unit);
}

// Reads the inches of "12'6\"" and "12 ft 6 in" behind the number of feet.
std::optional<double> take_inches(string_view rest) {
  bool feet = false;
  for (const string_view unit : {"feet", "foot", "ft.", "ft", "'"})
    if (!feet && rest.starts_with(unit)) {
      rest.remove_prefix(unit.size());
      feet = true;
    }
  if (!feet) return std::nullopt;
  if (rest.starts_with('-')) rest.remove_prefix(1);  // 32'-6", as drawings have it
  const auto inches = take_number(rest);
  if (!inches) return std::nullopt;
  const std::string unit = normalise_tag(rest);
  const auto metres = unit.empty() ? inch_m : find_metres_per(unit);
  return metres == inch_m ? inches : std::nullopt;
}

// Returns "1200 ft" for "1,200 ft", else "": who counts in feet parts thousands by a comma. In
// metres "1,200" may be either.
std::string drop_thousands_of_feet(string_view text) {
  const std::size_t comma = text.find(',');
  constexpr string_view digits = "0123456789";
  if (comma == text.npos || comma == 0 || comma > 3) return {};
  const string_view after = text.substr(comma + 1);
  const std::size_t end = std::min(after.find_first_not_of(digits), after.size());
  const std::string unit = normalise_tag(after.substr(end));
  if (text.find_first_not_of(digits) != comma || end != 3 ||
      (!unit.starts_with("f") && !unit.starts_with("'")))
    return {};
  return std::string(text.substr(0, comma)) + std::string(after);
}

// Returns "6 - 8 m" for "6 to 8 m", also in other languages.
std::string join_range(std::string text) {
  for (const string_view between : {" to ", " a ", " à ", " tot ", " bis ", " do "})
    if (const std::size_t at = text.find(between); at != text.npos && at > 0)
      return text.replace(at, between.size(), "-");
  return text;
}

// Returns the middle of a range whose lower end has a unit too: "3 m - 4 m". `rest`: what stands
// behind its number.
std::optional<double> take_upper_end(double lower, string_view rest) {
  const std::size_t at = rest.find_first_of("-~");
  if (at == rest.npos) return std::nullopt;
  const auto unit = find_metres_per(normalise_tag(rest.substr(0, at)));
  string_view behind = rest.substr(at + 1);
  const auto upper = take_number(behind);
  const auto upper_unit = find_metres_per(normalise_tag(behind));
  if (!unit || !upper || !upper_unit) return std::nullopt;
  return (lower * *unit + *upper * *upper_unit) / 2;
}

}  // namespace

std::optional<double> parse_length_m(string_view text) {
  const std::string plain = join_range(to_plain_signs(text));
  const auto parts = split_list(plain);
  if (parts.empty()) return std::nullopt;
  string_view rest = parts.front();
  skip_about(rest);
  const std::string without_thousands = drop_thousands_of_feet(rest);
  if (!without_thousands.empty()) rest = without_thousands;
  auto value = take_number(rest);
  if (!value) return std::nullopt;
  if (rest.starts_with('-') || rest.starts_with('~')) {
    rest.remove_prefix(1);
    const auto upper = take_number(rest);
    if (!upper) return std::nullopt;
    value = (*value + *upper) / 2;
  }
  rest = drop_remark(rest);
  if (const auto metres = find_metres_per(normalise_tag(rest))) return *value * *metres;
  if (const auto inches = take_inches(rest)) return *value * foot_m + *inches * inch_m;
  return take_upper_end(*value, rest);
}

std::optional<double> find_length_m(const OsmTags& tags, std::initializer_list<const char*> keys,
                                    double least_m, double greatest_m) {
  for (const char* key : keys)
    if (const auto found = tags.find(key); found != tags.end())
      if (const auto length = parse_length_m(found->second);
          length && *length >= least_m && *length <= greatest_m)
        return length;
  return std::nullopt;
}

}  // namespace nightcity::osm
