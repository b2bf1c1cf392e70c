#include "tools/lights/lit_tag.h"

#include <algorithm>
#include <array>
#include <string>

#include "tools/lights/is_one_of.h"
#include "tools/lights/lit_hours.h"
#include "tools/osm/tag_values.h"

namespace nightcity::lights {
namespace {

// Some write "no" in their own language, where "yes" is what would be taken without a word.
constexpr std::array<std::string_view, 19> dark_words = {
    "0",   "not_lit", "no",  "disused", "broken", "never", "none", "false", "off", "unlit",
    "não", "nao",     "nie", "nee",     "nein",   "non",   "нет",  "hayır", "nej"};
constexpr std::array<std::string_view, 6> whole_night = {"yes",       "automatic", "sunset_sunrise",
                                                         "dusk_dawn", "always",    "all_night"};
constexpr std::array<std::string_view, 4> part_of_night = {"limited", "interval", "half_night",
                                                           "part_time"};

}  // namespace

LitTag read_lit_tag(std::string_view text, Half half) {
  std::string word = osm::normalise_tag(text);
  // "no (broken)": a remark says why.
  if (const std::size_t remark = word.find("_("); remark != word.npos && word.ends_with(')'))
    word.resize(remark);
  if (word.empty() || word == "unknown") return {};
  if (is_one_of(word, dark_words)) return {LitTag::Kind::dark, {}};
  if (is_one_of(word, whole_night)) return {LitTag::Kind::lit, {}};
  if (is_one_of(word, part_of_night))
    return {LitTag::Kind::lit, dark_between(minute_of(23, 0), minute_of(5, 0))};
  if (const auto hours = parse_lit_hours(text, half)) {
    if (hours->never()) return {LitTag::Kind::dark, {}};
    return {LitTag::Kind::lit, hours};
  }
  return {LitTag::Kind::not_understood, {}};
}

std::optional<NightSchedule> read_lit_condition(std::string_view text, bool is_lit, Half half) {
  const std::size_t at = text.find('@');
  if (at == std::string_view::npos || text.find('@', at + 1) != std::string_view::npos) return {};
  const LitTag then = read_lit_tag(text.substr(0, at), half);
  const LitTag::Kind other = is_lit ? LitTag::Kind::dark : LitTag::Kind::lit;
  const std::size_t open = text.find_first_not_of(' ', at + 1), close = text.find_last_not_of(' ');
  if (then.kind != other || then.hours || open >= close) return {};
  const bool has_brackets = text[open] == '(' && text[close] == ')';
  const auto hours = parse_lit_hours(
      has_brackets ? text.substr(open + 1, close - open - 1) : text.substr(open, close - open + 1),
      half);
  if (!hours || !is_lit) return hours;
  NightSchedule rest;
  std::size_t used = 0;
  std::uint16_t from = 0;
  const auto add = [&](std::uint16_t to) {
    if (from >= to) return true;
    if (used == rest.on.size()) return false;
    rest.on[used] = from;
    rest.off[used++] = to;
    return true;
  };
  for (std::size_t i = 0; i < hours->on.size(); ++i) {
    if (hours->on[i] >= hours->off[i]) continue;
    if (!add(hours->on[i])) return {};
    from = hours->off[i];
  }
  if (!add(night_minutes) || rest.never()) return {};
  return rest;
}

LitTags read_lit_tags(const osm::OsmTags& tags, const std::string& key, Half half) {
  LitTags read;
  const auto found = tags.find(key);
  if (found != tags.end()) {
    read.lit = read_lit_tag(found->second, half);
    if (read.lit.kind == LitTag::Kind::not_understood)
      read.unread.push_back(key + "=" + found->second);
  }
  const auto condition = tags.find(key + ":conditional");
  if (condition == tags.end()) return read;
  std::optional<NightSchedule> hours;
  if (!read.lit.hours) {
    hours = read_lit_condition(condition->second, read.lit.kind != LitTag::Kind::dark, half);
    if (!hours && read.lit.kind == LitTag::Kind::unknown)
      hours = read_lit_condition(condition->second, false, half);
  }
  if (!hours)
    read.unread.push_back(key + ":conditional=" + condition->second);
  else if (hours->never())
    read.lit.kind = LitTag::Kind::dark;
  else
    read.lit = {LitTag::Kind::lit, hours};
  return read;
}

}  // namespace nightcity::lights
