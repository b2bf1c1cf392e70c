// Checks that hold for every text of a tag, whatever people write: for the
// fuzz target and the test of its corpus.
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "tools/lights/lamp_tags.h"
#include "tools/lights/lit_hours.h"
#include "tools/lights/lit_tag.h"
#include "tools/map_buildings/levels_text.h"
#include "tools/osm/colour_words.h"
#include "tools/osm/lifecycle.h"
#include "tools/osm/tag_values.h"

namespace nightcity::test {

inline bool is_sound(const std::optional<lights::NightSchedule>& hours) {
  if (!hours) return true;
  int last = 0;
  for (std::size_t i = 0; i < hours->on.size(); ++i) {
    if (hours->on[i] == hours->off[i]) continue;
    if (hours->on[i] < last || hours->off[i] < hours->on[i]) return false;
    last = hours->off[i];
  }
  return last <= lights::night_minutes;
}

/// Returns which reader of values is wrong about `text`; "" where none is.
inline std::string find_fault_of_value(std::string_view text) {
  const auto finite = [](const std::optional<double>& value) {
    return !value || std::isfinite(*value);
  };
  if (!is_sound(lights::parse_lit_hours(text))) return "parse_lit_hours";
  if (!is_sound(lights::read_lit_tag(text).hours)) return "read_lit_tag";
  for (const bool is_lit : {false, true})
    if (!is_sound(lights::read_lit_condition(text, is_lit))) return "read_lit_condition";
  if (!finite(osm::parse_lumens(text))) return "parse_lumens";
  if (!finite(osm::parse_watts(text))) return "parse_watts";
  if (!finite(osm::parse_length_m(text))) return "parse_length_m";
  if (!finite(lights::parse_cct_k(text))) return "parse_cct_k";
  if (const auto levels = map_buildings::parse_levels(text); levels && !finite(levels->count))
    return "parse_levels";
  if (const auto colour = osm::parse_colour(text); colour && *colour > 0xffffff)
    return "parse_colour";
  if (const auto days = osm::parse_days(text); days && days->last < days->first)
    return "parse_days";
  return "";
}

/// Reads lines of KEY=VALUE as the tags of a lamp, and each value by itself.
inline std::string find_fault_of_tags(std::string_view text) {
  osm::OsmTags tags;
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const std::size_t sign = line.find('=');
    const std::string_view value = sign == line.npos ? line : line.substr(sign + 1);
    if (std::string fault = find_fault_of_value(value); !fault.empty()) return fault;
    if (sign != line.npos) tags[std::string(line.substr(0, sign))] = std::string(value);
  }
  const lights::LampTags lamp = lights::read_lamp_tags(tags);
  for (const auto& value :
       {lamp.height_m, lamp.flux_lm, lamp.power_w, lamp.cct_k, lamp.tilt_degrees, lamp.ele_m})
    if (value && !std::isfinite(*value)) return "read_lamp_tags";
  for (const double direction : lamp.directions_degrees)
    if (!std::isfinite(direction)) return "directions";
  if (lamp.count < 1 || lamp.count > 12 || lamp.count < int(lamp.directions_degrees.size()))
    return "count";
  if (!is_sound(lamp.hours) || !is_sound(lights::read_lit_tags(tags, "lit").lit.hours))
    return "hours";
  const osm::Day day{std::chrono::days(20000)};
  osm::is_gone(tags, day);
  osm::is_out_of_use(tags, day);
  return "";
}

}  // namespace nightcity::test
