#include "tools/map_buildings/levels_text.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "tools/osm/tag_values.h"

namespace nightcity::map_buildings {
namespace {

using std::string_view;

bool is_word_for_levels(string_view text) {
  constexpr std::array<string_view, 35> words{
      "level",      "levels",       "floor",     "floors",  "fl",          "fl.",         "f",
      "storey",     "storeys",      "story",     "stories", "etages",      "étages",      "etagen",
      "stock",      "stockwerke",   "geschosse", "plantas", "pisos",       "piani",       "этажа",
      "этажей",     "層",           "층",        "階",      "階建",        "階建て",      "andares",
      "pavimentos", "verdiepingen", "bouwlagen", "lagen",   "kondygnacje", "kondygnacji", "kat"};
  return std::find(words.begin(), words.end(), text) != words.end();
}

// Takes the word for a ground floor and a plus sign off the front of "G+4" and "parter + 2"; in
// India cars stand on that of "S+4", between the stilts.
bool take_ground_floor(string_view& text) {
  const std::size_t plus = text.find('+');
  if (plus == text.npos || plus + 1 == text.size()) return false;
  constexpr std::array<string_view, 16> words{
      "eg",    "rdc",    "gf",     "pb",     "g",  "r",  "p",      "s",
      "stilt", "parter", "térreo", "terreo", "bg", "ug", "ground", "ground_floor"};
  const std::string word = osm::normalise_tag(text.substr(0, plus));
  if (std::find(words.begin(), words.end(), word) == words.end()) return false;
  text.remove_prefix(plus + 1);
  while (text.starts_with(' ')) text.remove_prefix(1);
  return true;
}

// Takes the basements off the front of "B+G+4" and "2B+G+4".
void drop_basements(string_view& text) {
  const std::size_t plus = text.find('+');
  if (plus == text.npos) return;
  const std::string word = osm::normalise_tag(text.substr(0, plus));
  if (word == "b" || word == "1b" || word == "2b" || word == "3b") text.remove_prefix(plus + 1);
}

bool is_ground_floor_alone(string_view text) {
  constexpr std::array<string_view, 9> words{"parter", "térreo", "terreo",       "eg",  "rdc",
                                             "gf",     "pb",     "ground_floor", "平屋"};
  const std::string word = osm::normalise_tag(text);
  return std::find(words.begin(), words.end(), word) != words.end();
}

// Takes "above the ground" off the front of "地上3階地下1階", and what is below off its end.
void keep_above_ground(string_view& text) {
  constexpr string_view above = "地上", below = "地下";
  if (text.starts_with(above)) text.remove_prefix(above.size());
  if (const std::size_t at = text.find(below); at != text.npos && at > 0) text = text.substr(0, at);
}

// Takes a fraction of a level off the front of the rest of "1½" and "2 1/2".
double take_fraction(string_view& text) {
  constexpr std::pair<string_view, double> fractions[] = {{"\xc2\xbd", 0.5},  {"\xc2\xbc", 0.25},
                                                          {"\xc2\xbe", 0.75}, {"1/2", 0.5},
                                                          {"1/4", 0.25},      {"3/4", 0.75}};
  for (const auto& [sign, value] : fractions)
    if (text.starts_with(sign)) {
      text.remove_prefix(sign.size());
      while (text.starts_with(' ')) text.remove_prefix(1);
      return value;
    }
  return 0;
}

std::optional<Levels> parse_one(string_view text) {
  while (text.starts_with('~') || text.starts_with(' ')) text.remove_prefix(1);
  if (is_ground_floor_alone(text)) return Levels{1, true};
  drop_basements(text);
  keep_above_ground(text);
  const double below = take_ground_floor(text) ? 1 : 0;  // levels that the number does not count
  const double alone = take_fraction(text);
  auto count = alone > 0 ? std::optional(alone) : osm::take_number(text);
  if (!count) return {};
  if (alone == 0) *count += take_fraction(text);
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
