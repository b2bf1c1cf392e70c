#include "tools/lights/lamp_state.h"

#include <algorithm>
#include <array>

#include "tools/lights/is_one_of.h"
#include "tools/osm/tag_values.h"

namespace nightcity::lights {
namespace {

using std::string_view;
using namespace std::string_view_literals;

constexpr std::array<string_view, 10> gone_keys = {
    "disused",   "abandoned",  "demolished", "removed",      "razed",
    "destroyed", "dismantled", "ruined",     "construction", "proposed"};
// In English and as authorities of other countries write them in their inventories.
constexpr std::array broken_words = {
    // broken
    "broken"sv, "defective"sv, "defect"sv, "defekt"sv, "damaged"sv, "faulty"sv, "fault"sv,
    "failed"sv, "dead"sv, "burned_out"sv, "burnt_out"sv, "vandalised"sv, "vandalized"sv,
    "en_panne"sv, "guasto"sv, "averiada"sv,
    // switched off or out of use
    "out_of_order"sv, "out_of_service"sv, "out_of_use"sv, "out"sv, "closed"sv, "disabled"sv,
    "decommissioned"sv, "inactive"sv, "off"sv, "no"sv, "false"sv, "not_working"sv, "not_in_use"sv,
    "not_in_service"sv, "non_operational"sv, "not_operational"sv, "inoperative"sv, "unused"sv,
    "disused"sv, "retired"sv, "stillgelegt"sv, "ausser_betrieb"sv,
    "au\xc3\x9f"
    "er_betrieb"sv,
    "hors_service"sv, "fuera_de_servicio"sv, "fuori_servizio"sv, "non_operativo"sv,
    "buiten_gebruik"sv,
    // gone
    "destroyed"sv, "missing"sv, "removed"sv, "dismantled"sv, "demolished"sv, "abandoned"sv,
    "abandoned_in_place"sv, "demontiert"sv, "abgebaut"sv,
    // not there yet
    "planned"sv, "proposed"sv, "future"sv, "under_construction"sv, "construction"sv, "geplant"sv,
    "im_bau"sv};
constexpr std::array working_words = {
    "operational"sv, "operating"sv, "operative"sv, "in_operation"sv, "yes"sv,
    "true"sv,        "on"sv,        "working"sv,   "ok"sv,           "functional"sv,
    "functioning"sv, "open"sv,      "active"sv,    "in_use"sv,       "in_service"sv,
    "good"sv,        "normal"sv,    "installed"sv, "existing"sv,     "live"sv,
    "energized"sv,   "current"sv,   "aktiv"sv,     "in_betrieb"sv,   "en_service"sv};

const std::string* find(const osm::OsmTags& tags, string_view key) {
  const auto found = tags.find(std::string(key));
  return found == tags.end() ? nullptr : &found->second;
}

bool says(const osm::OsmTags& tags, const char* key, std::initializer_list<string_view> words) {
  const std::string* text = find(tags, key);
  return text && std::find(words.begin(), words.end(), osm::normalise_tag(*text)) != words.end();
}

}  // namespace

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

string_view find_outage(const osm::OsmTags& tags, Day day,
                        std::map<std::string, std::size_t>& unread) {
  const auto count_unread = [&](string_view key, const std::string& text) {
    ++unread[std::string(key) + "=" + text];
  };
  for (const string_view key : gone_keys) {
    const std::string* text = find(tags, key);
    if (text && osm::says_since(*text, day)) return "disused or demolished";
  }
  for (const char* key : {"operational_status", "light:operational_status", "lamp:status"}) {
    const std::string* text = find(tags, key);
    if (!text) continue;
    for (const string_view part : osm::split_list(*text)) {
      const std::string word = osm::normalise_tag(part);
      if (is_one_of(word, broken_words)) return "broken";
      if (!is_one_of(word, working_words)) count_unread(key, std::string(part));
    }
  }
  if (const std::string* text = find(tags, "end_date")) {
    const auto end = parse_days(*text);
    if (end && end->last < day) return "end_date past";
    if (!end) count_unread("end_date", *text);
  }
  for (const char* key : {"start_date", "opening_date"}) {
    const std::string* text = find(tags, key);
    if (!text) continue;
    const auto start = parse_days(*text);
    if (start && start->first > day) return "start_date ahead";
    if (!start) count_unread(key, *text);
  }
  return is_below_ground(tags) ? "underground" : "";
}

}  // namespace nightcity::lights
