#include "tools/osm/tag_values.h"

#include <charconv>
#include <cmath>

namespace nightcity::osm {
namespace {

using std::string_view;

void skip_blanks(string_view& text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
}

}  // namespace

std::string normalise_tag(std::string_view value) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (!value.empty() && blank(value.front())) value.remove_prefix(1);
  while (!value.empty() && blank(value.back())) value.remove_suffix(1);
  std::string result(value);
  for (char& c : result) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    if (blank(c) || c == '-') c = '_';
  }
  return result;
}

std::vector<string_view> split_list(string_view text) {
  std::vector<string_view> parts;
  while (true) {
    const std::size_t end = text.find(';');
    string_view part = text.substr(0, end);
    skip_blanks(part);
    while (!part.empty() && part.back() == ' ') part.remove_suffix(1);
    if (!part.empty()) parts.push_back(part);
    if (end == string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::optional<double> take_number(string_view& text) {
  skip_blanks(text);
  std::string digits;
  for (const char c : text) {
    if (!((c >= '0' && c <= '9') || c == '.' || c == ',' || (c == '-' && digits.empty()))) break;
    digits += c == ',' ? '.' : c;
  }
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - digits.data()));
  skip_blanks(text);
  return value;
}

std::optional<double> parse_length_m(string_view text) {
  const auto parts = split_list(text);
  if (parts.empty()) return std::nullopt;
  string_view rest = parts.front();
  while (!rest.empty() && (rest.front() == '~' || rest.front() == '<' || rest.front() == '>'))
    rest.remove_prefix(1);
  if (rest.starts_with("ca.")) rest.remove_prefix(3);
  auto value = take_number(rest);
  if (!value) return std::nullopt;
  if (rest.starts_with("-")) {
    rest.remove_prefix(1);
    const auto upper = take_number(rest);
    if (!upper) return std::nullopt;
    value = (*value + *upper) / 2;
  }
  constexpr double foot = 0.3048;
  const std::string unit = normalise_tag(rest);
  if (unit.empty() || unit == "m" || unit == "meter" || unit == "meters" || unit == "metre" ||
      unit == "metres" || unit == "mt" || unit == "m.")
    return value;
  if (unit == "cm") return *value / 100;
  if (unit == "mm") return *value / 1000;
  if (unit == "ft" || unit == "feet" || unit == "foot" || unit == "'" || unit == "ft.")
    return *value * foot;
  if (rest.front() == '\'') {  // feet and inches
    rest.remove_prefix(1);
    const auto inches = take_number(rest);
    if (inches && (rest == "\"" || rest == "''" || rest.empty()))
      return (*value + *inches / 12) * foot;
  }
  return std::nullopt;
}

}  // namespace nightcity::osm
