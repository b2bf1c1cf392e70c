#include "tools/osm/days.h"

#include <charconv>
#include <cstddef>
#include <string>

#include "tools/osm/tag_values.h"

namespace nightcity::osm {
namespace {

using std::string_view;

/// Takes digits from the front of the text as a number.
std::optional<int> take_digits(string_view& text, std::size_t count) {
  int value = 0;
  if (text.size() < count) return std::nullopt;
  const auto [end, error] = std::from_chars(text.data(), text.data() + count, value);
  if (error != std::errc() || end != text.data() + count || value < 0) return std::nullopt;
  text.remove_prefix(count);
  return value;
}

}  // namespace

std::optional<Days> parse_days(string_view text) {
  using namespace std::chrono;
  constexpr std::size_t longest = 60;  // bounds the parts of parts
  if (text.size() > longest) return std::nullopt;
  while (text.starts_with(' ') || text.starts_with('~')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  if (const std::size_t dots = text.find(".."); dots != string_view::npos) {
    const auto from = parse_days(text.substr(0, dots)), to = parse_days(text.substr(dots + 2));
    return from && to && from->first <= to->last ? std::optional(Days{from->first, to->last})
                                                 : std::nullopt;
  }
  if (text.starts_with("before ")) {
    const auto then = parse_days(text.substr(7));
    return then ? std::optional(Days{Day::min(), then->first}) : std::nullopt;
  }
  for (const string_view part : {"early ", "mid ", "late "})
    if (text.starts_with(part)) return parse_days(text.substr(part.size()));
  const auto whole_years = [](int from, int to) {
    return Days{Day(year(from) / January / 1), Day(year(to) / December / 31)};
  };
  if (text.starts_with('C')) {  // a century
    text.remove_prefix(1);
    const auto century = take_digits(text, 2);
    if (!century || *century == 0 || !text.empty()) return std::nullopt;
    return whole_years(100 * (*century - 1), 100 * *century - 1);
  }
  const auto number = take_digits(text, 4);
  if (!number) return std::nullopt;
  if (text == "s") return whole_years(*number, *number + 9);
  if (text.empty()) return whole_years(*number, *number);
  text.remove_prefix(1);
  const auto month_number = take_digits(text, 2);
  if (!month_number) return std::nullopt;
  const auto month_of = month(static_cast<unsigned>(*month_number));
  if (!month_of.ok()) return std::nullopt;
  if (text.empty())
    return Days{Day(year(*number) / month_of / 1), Day(year(*number) / month_of / last)};
  text.remove_prefix(1);
  const auto day_number = take_digits(text, 2);
  // Databases write the time of the day as well: "2015-05-03T12:00:00Z".
  const bool has_time = text.starts_with('T') || text.starts_with(' ');
  if (!day_number || !(text.empty() || has_time)) return std::nullopt;
  const auto date = year(*number) / month_of / day(static_cast<unsigned>(*day_number));
  return date.ok() ? std::optional(Days{Day(date), Day(date)}) : std::nullopt;
}

bool says_since(string_view value, Day day) {
  const std::string word = normalise_tag(value);
  const auto since = parse_days(value);
  return word == "yes" || word == "true" || word == "1" || (since && since->first <= day);
}

}  // namespace nightcity::osm
