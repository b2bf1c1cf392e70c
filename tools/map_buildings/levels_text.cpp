#include "tools/map_buildings/levels_text.h"

#include <algorithm>
#include <array>
#include <string>

#include "tools/osm/tag_values.h"

namespace nightcity::map_buildings {
namespace {

using std::string_view;

bool is_word_for_levels(string_view text) {
  constexpr std::array<string_view, 11> words{"level",   "levels", "floor",   "floors",
                                              "fl",      "storey", "storeys", "story",
                                              "stories", "etages", "plantas"};
  return std::find(words.begin(), words.end(), text) != words.end();
}

std::optional<Levels> parse_one(string_view text) {
  double below = 0;  // levels that the number does not count
  if (text.size() > 2 && text[1] == '+' && string_view("GRPgrp").find(text[0]) != text.npos) {
    below = 1;
    text.remove_prefix(2);
  }
  while (text.starts_with('~') || text.starts_with(' ')) text.remove_prefix(1);
  auto count = osm::take_number(text);
  if (!count) return {};
  if (text.starts_with('-')) {
    string_view behind = text.substr(1);
    if (const auto upper = osm::take_number(behind)) {
      count = (*count + *upper) / 2;
      text = behind;
    }
  }
  return Levels{*count + below, text.empty() || is_word_for_levels(osm::normalise_tag(text))};
}

}  // namespace

std::optional<Levels> parse_levels(string_view text) {
  const std::string plain = osm::to_plain_signs(text);
  std::optional<Levels> most;
  for (const string_view part : osm::split_list(plain)) {
    const auto levels = parse_one(part);
    if (!levels) continue;
    if (!most) most = Levels{levels->count, true};
    most->count = std::max(most->count, levels->count);
    most->is_whole = most->is_whole && levels->is_whole;
  }
  return most;
}

}  // namespace nightcity::map_buildings
