#include "tools/lights/lit_tag.h"

#include <algorithm>
#include <array>
#include <string>

#include "tools/lights/is_one_of.h"
#include "tools/osm/tag_values.h"

namespace nightcity::lights {
namespace {

constexpr std::array<std::string_view, 7> dark_words = {"no",   "disused", "broken", "never",
                                                        "none", "false",   "off"};
constexpr std::array<std::string_view, 6> whole_night = {"yes",       "automatic", "sunset_sunrise",
                                                         "dusk_dawn", "always",    "all_night"};
constexpr std::array<std::string_view, 4> part_of_night = {"limited", "interval", "half_night",
                                                           "part_time"};

}  // namespace

LitTag read_lit_tag(std::string_view text) {
  const std::string word = osm::normalise_tag(text);
  if (word.empty() || word == "unknown") return {};
  if (is_one_of(word, dark_words)) return {LitTag::Kind::dark, {}};
  if (is_one_of(word, whole_night)) return {LitTag::Kind::lit, {}};
  if (is_one_of(word, part_of_night))
    return {LitTag::Kind::lit, dark_between(minute_of(23, 0), minute_of(5, 0))};
  if (const auto hours = parse_lit_hours(text)) return {LitTag::Kind::lit, hours};
  return {LitTag::Kind::not_understood, {}};
}

}  // namespace nightcity::lights
