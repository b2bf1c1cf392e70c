// Rules of hours as OpenStreetMap writes them (OSM wiki, Key:opening_hours): the part of the
// grammar that lights use.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "tools/lights/night_schedule.h"

namespace nightcity::lights {

/// Minutes after midnight of the day that a rule is for; an end may lie on the next day.
struct HoursSpan {
  int from, to;
};

struct HoursRule {
  std::vector<HoursSpan> spans;  // apart from each other; none: an `is_off` of whole days
  /// Says whether the rule is for the day of the evening and for that of the morning of our night:
  /// a Wednesday and a Thursday of December, in the south of June.
  std::array<bool, 2> holds{true, true};
  bool is_for_some_days = false;  // it names days or seasons
  bool is_off = false;
};

/// Returns the rules of a text in their order; empty where any of it cannot be read.
std::optional<std::vector<HoursRule>> read_hours_rules(std::string_view text,
                                                       Half half = Half::north);

}  // namespace nightcity::lights
