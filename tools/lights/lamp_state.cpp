#include "tools/lights/lamp_state.h"

#include <algorithm>
#include <array>

#include "tools/lights/is_one_of.h"
#include "tools/osm/tag_values.h"

namespace nightcity::lights {
namespace {

using std::string_view;

constexpr std::array<string_view, 10> gone_keys = {
    "disused",   "abandoned",  "demolished", "removed",      "razed",
    "destroyed", "dismantled", "ruined",     "construction", "proposed"};
constexpr std::array<string_view, 28> broken_words = {
    "broken",      "out_of_order",    "out_of_service",  "defective",  "defect",     "damaged",
    "closed",      "disabled",        "decommissioned",  "inactive",   "off",        "no",
    "not_working", "non_operational", "not_operational", "faulty",     "vandalised", "vandalized",
    "destroyed",   "missing",         "removed",         "dismantled", "demolished", "abandoned",
    "disused",     "not_in_use",      "unused",          "false"};
constexpr std::array<string_view, 11> working_words = {"operational", "yes",    "working", "ok",
                                                       "functional",  "open",   "active",  "in_use",
                                                       "good",        "normal", "true"};

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

}  // namespace

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
