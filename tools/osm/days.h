// Dates of OpenStreetMap.
#pragma once

#include <chrono>
#include <optional>
#include <string_view>

namespace nightcity::osm {

using Day = std::chrono::sys_days;

struct Days {
  Day first, last;
};

/// Returns the first and last day of a date of OSM (its wiki, "Key:start_date"): "2015-05-01",
/// "2015-05", "2015", "1980s", "~1998", "C19", "late 1990s", "before 1950", "2010..2015"; a time of
/// the day behind a day is not looked at. Empty for other texts.
std::optional<Days> parse_days(std::string_view text);

/// Returns whether the value of a key such as `demolished` says that it is so on that day: "yes",
/// "true", "1", or a date that is not ahead.
bool says_since(std::string_view value, Day day);

}  // namespace nightcity::osm
