#include "tools/lights/lamp_state.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>

#include "tools/lights/is_one_of.h"
#include "tools/osm/tag_values.h"

namespace nightcity::lights {
namespace {

using std::string_view;

constexpr std::array<string_view, 10> gone_keys = {
    "disused",   "abandoned",  "demolished", "removed",      "razed",
    "destroyed", "dismantled", "ruined",     "construction", "proposed"};
constexpr std::array<string_view, 15> broken_words = {
    "broken",  "out_of_order", "out_of_service", "defective",       "defect",
    "damaged", "closed",       "disabled",       "decommissioned",  "inactive",
    "off",     "no",           "not_working",    "non_operational", "not_operational"};
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

std::optional<Day> parse_last_day(string_view text) {
  using namespace std::chrono;
  while (text.starts_with(' ') || text.starts_with('~')) text.remove_prefix(1);
  while (text.ends_with(' ')) text.remove_suffix(1);
  const auto number = take_digits(text, 4);
  if (!number) return std::nullopt;
  if (text == "s") return Day(year(*number + 9) / December / 31);
  if (text.empty()) return Day(year(*number) / December / 31);
  text.remove_prefix(1);
  const auto month_number = take_digits(text, 2);
  if (!month_number) return std::nullopt;
  const auto month_of = month(static_cast<unsigned>(*month_number));
  if (!month_of.ok()) return std::nullopt;
  if (text.empty()) return Day(year(*number) / month_of / last);
  text.remove_prefix(1);
  const auto day_number = take_digits(text, 2);
  if (!day_number || !text.empty()) return std::nullopt;
  const auto date = year(*number) / month_of / day(static_cast<unsigned>(*day_number));
  return date.ok() ? std::optional(Day(date)) : std::nullopt;
}

Day today() {
  using namespace std::chrono;
  if (const char* text = std::getenv("SOURCE_DATE_EPOCH")) {
    std::int64_t value = 0;
    const char* end = text + std::strlen(text);
    if (const auto [stop, error] = std::from_chars(text, end, value);
        error == std::errc() && stop == end && std::abs(value) < 1'000'000'000'000)
      return floor<days>(sys_seconds(seconds(value)));
  }
  return floor<days>(system_clock::now());
}

string_view find_outage(const osm::OsmTags& tags, Day day,
                        std::map<std::string, std::size_t>& unread) {
  const auto count_unread = [&](string_view key, const std::string& text) {
    ++unread[std::string(key) + "=" + text];
  };
  for (const string_view key : gone_keys)
    if (const std::string* text = find(tags, key); text && osm::normalise_tag(*text) == "yes")
      return "disused or demolished";
  for (const char* key : {"operational_status", "light:operational_status", "lamp:status"}) {
    const std::string* text = find(tags, key);
    if (!text) continue;
    const std::string word = osm::normalise_tag(*text);
    if (is_one_of(word, broken_words)) return "broken";
    if (!is_one_of(word, working_words)) count_unread(key, *text);
  }
  if (const std::string* text = find(tags, "end_date")) {
    const auto end = parse_last_day(*text);
    if (end && *end < day) return "end_date past";
    if (!end) count_unread("end_date", *text);
  }
  if (const std::string* text = find(tags, "start_date"))
    if (const auto start = parse_last_day(*text); start && *start > day && text->size() == 10)
      return "start_date ahead";
  return is_below_ground(tags) ? "underground" : "";
}

}  // namespace nightcity::lights
