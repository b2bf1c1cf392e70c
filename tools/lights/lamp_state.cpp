#include "tools/lights/lamp_state.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "tools/lights/is_one_of.h"
#include "tools/osm/tag_values.h"

namespace nightcity::lights {
namespace {

using std::string_view;

constexpr std::array<string_view, 10> gone_keys = {
    "disused",   "abandoned",  "demolished", "removed",      "razed",
    "destroyed", "dismantled", "ruined",     "construction", "proposed"};
constexpr std::array<string_view, 27> broken_words = {
    "broken",      "out_of_order",    "out_of_service",  "defective",  "defect",     "damaged",
    "closed",      "disabled",        "decommissioned",  "inactive",   "off",        "no",
    "not_working", "non_operational", "not_operational", "faulty",     "vandalised", "vandalized",
    "destroyed",   "missing",         "removed",         "dismantled", "demolished", "abandoned",
    "disused",     "not_in_use",      "unused"};
constexpr std::array<string_view, 10> working_words = {"operational", "yes",   "working", "ok",
                                                       "functional",  "open",  "active",  "in_use",
                                                       "good",        "normal"};

const std::string* find(const osm::OsmTags& tags, string_view key) {
  const auto found = tags.find(std::string(key));
  return found == tags.end() ? nullptr : &found->second;
}

bool says(const osm::OsmTags& tags, const char* key, std::initializer_list<string_view> words) {
  const std::string* text = find(tags, key);
  return text && std::find(words.begin(), words.end(), osm::normalise_tag(*text)) != words.end();
}

bool is_below_ground(const osm::OsmTags& tags) {
  if (says(tags, "location", {"underground", "indoor"}) || says(tags, "tunnel", {"yes"}) ||
      says(tags, "indoor", {"yes"}))
    return true;
  for (const char* key : {"level", "layer"}) {
    const std::string* text = find(tags, key);
    if (!text) continue;
    string_view rest = *text;
    const auto number = osm::take_number(rest);
    if (number && rest.empty() && *number < 0) return true;
  }
  return false;
}

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
    return from && to ? std::optional(Days{from->first, to->last}) : std::nullopt;
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
  if (!day_number || !text.empty()) return std::nullopt;
  const auto date = year(*number) / month_of / day(static_cast<unsigned>(*day_number));
  return date.ok() ? std::optional(Days{Day(date), Day(date)}) : std::nullopt;
}

string_view find_outage(const osm::OsmTags& tags, Day day,
                        std::map<std::string, std::size_t>& unread) {
  const auto count_unread = [&](string_view key, const std::string& text) {
    ++unread[std::string(key) + "=" + text];
  };
  for (const string_view key : gone_keys) {
    const std::string* text = find(tags, key);
    if (!text) continue;
    const std::string word = osm::normalise_tag(*text);
    const auto since = parse_days(*text);  // demolished=2019-05
    if (word == "yes" || word == "true" || word == "1" || (since && since->first <= day))
      return "disused or demolished";
  }
  for (const char* key : {"operational_status", "light:operational_status", "lamp:status"}) {
    const std::string* text = find(tags, key);
    if (!text) continue;
    const std::string word = osm::normalise_tag(*text);
    if (is_one_of(word, broken_words)) return "broken";
    if (!is_one_of(word, working_words)) count_unread(key, *text);
  }
  if (const std::string* text = find(tags, "end_date")) {
    const auto end = parse_days(*text);
    if (end && end->last < day) return "end_date past";
    if (!end) count_unread("end_date", *text);
  }
  if (const std::string* text = find(tags, "start_date"))
    if (const auto start = parse_days(*text); start && start->first > day)
      return "start_date ahead";
  return is_below_ground(tags) ? "underground" : "";
}

}  // namespace nightcity::lights
