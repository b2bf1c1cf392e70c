#include "tools/osm/tag_values.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <utility>

namespace nightcity::osm {
namespace {

using std::string_view;

void skip_blanks(string_view& text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
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

const std::string& find_raw_tag(const OsmTags& tags, const std::string& key) {
  static const std::string none;
  const auto found = tags.find(key);
  return found == tags.end() ? none : found->second;
}

std::string find_tag(const OsmTags& tags, const std::string& key) {
  return normalise_tag(find_raw_tag(tags, key));
}

bool is_tagged(const OsmTags& tags, const std::string& key) {
  const std::string value = find_tag(tags, key);
  return !value.empty() && value != "no";
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

std::optional<double> take_amount(string_view& text, double least) {
  skip_blanks(text);
  // A separator of thousands before each group of three digits, the same before all of them.
  std::string digits;
  std::size_t at = 0;
  while (at < text.size() && is_digit(text[at])) digits += text[at++];
  if (digits.empty() || digits.size() > 3 || digits.front() == '0') return take_number(text);
  const auto is_group = [&](std::size_t from) {
    if (from + 4 > text.size()) return false;
    for (std::size_t i = from + 1; i < from + 4; ++i)
      if (!is_digit(text[i])) return false;
    return from + 4 == text.size() || !is_digit(text[from + 4]);
  };
  const char separator = at < text.size() ? text[at] : '\0';
  if (string_view(",.' ").find(separator) == string_view::npos || !is_group(at))
    return take_number(text);
  std::size_t groups = 0;
  for (; at < text.size() && text[at] == separator && is_group(at); at += 4, ++groups)
    digits += text.substr(at + 1, 3);
  double value = 0;
  std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool may_be_decimal = groups == 1 && (separator == '.' || separator == ',');
  if (may_be_decimal && value / 1000 >= least) return take_number(text);
  text.remove_prefix(at);
  // "1,250.50"
  if (text.size() > 1 && (text[0] == '.' || text[0] == ',') && is_digit(text[1])) {
    std::string fraction = "0.";
    for (text.remove_prefix(1); !text.empty() && is_digit(text.front()); text.remove_prefix(1))
      fraction += text.front();
    double part = 0;
    std::from_chars(fraction.data(), fraction.data() + fraction.size(), part);
    value += part;
  }
  skip_blanks(text);
  return value;
}

namespace {

// Reads an amount in a unit that is among the first, or a thousand of it among the second.
std::optional<double> parse_amount(string_view text, double least,
                                   std::initializer_list<string_view> units,
                                   std::initializer_list<string_view> kilo) {
  const std::string plain = to_plain_signs(text);
  string_view rest = plain;
  if (rest.starts_with('~')) rest.remove_prefix(1);
  const auto is_in = [](std::initializer_list<string_view> names, string_view unit) {
    return std::find(names.begin(), names.end(), normalise_tag(unit)) != names.end();
  };
  string_view behind = rest;  // "3.500 klm" are three and a half
  if (const auto few = take_number(behind); few && is_in(kilo, behind)) return *few * 1000;
  const auto value = take_amount(rest, least);
  return value && (rest.empty() || is_in(units, rest)) ? value : std::nullopt;
}

}  // namespace

std::optional<double> parse_lumens(string_view text) {
  constexpr double least = 100;
  return parse_amount(text, least, {"lm", "lumen", "lumens"}, {"klm", "k_lm", "kilolumen"});
}

double take_factor(string_view& text) {
  constexpr double most = 12;
  string_view rest = text;
  skip_blanks(rest);
  const std::size_t digits = rest.find_first_not_of("0123456789");
  if (digits == 0 || digits > 2) return 1;
  const auto factor = take_number(rest);
  if (!factor || *factor < 1 || *factor > most) return 1;
  for (const string_view times : {"x", "X", "*", "\xc3\x97"}) {
    if (!rest.starts_with(times)) continue;
    rest.remove_prefix(times.size());
    skip_blanks(rest);
    if (rest.empty() || !is_digit(rest.front())) return 1;
    text = rest;
    return *factor;
  }
  return 1;
}

std::optional<double> parse_watts(string_view text) {
  constexpr double least = 3;
  const double factor = take_factor(text);
  const auto one = parse_amount(
      text, least, {"w", "watt", "watts", "wat", "wats", "vatios", "watios", "вт", "Вт"},
      {"kw", "kilowatt"});
  return one ? std::optional(factor * *one) : std::nullopt;
}

}  // namespace nightcity::osm
