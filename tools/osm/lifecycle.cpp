#include "tools/osm/lifecycle.h"

#include <optional>

namespace nightcity::osm {
namespace {

bool says(const OsmTags& tags, const char* key, Day day) {
  const auto found = tags.find(key);
  return found != tags.end() && says_since(found->second, day);
}

std::optional<Days> find_days(const OsmTags& tags, const char* key) {
  const auto found = tags.find(key);
  return found == tags.end() ? std::nullopt : parse_days(found->second);
}

}  // namespace

bool is_gone(const OsmTags& tags, Day day) {
  if (tags.empty()) return false;
  for (const char* key : {"demolished", "razed", "removed", "destroyed", "dismantled"})
    if (says(tags, key, day)) return true;
  if (const auto end = find_days(tags, "end_date"); end && end->last < day) return true;
  for (const char* key : {"start_date", "opening_date"})
    if (const auto start = find_days(tags, key); start && start->first > day) return true;
  return false;
}

bool is_out_of_use(const OsmTags& tags, Day day) {
  return says(tags, "disused", day) || says(tags, "abandoned", day);
}

}  // namespace nightcity::osm
