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
/// "2015-05", "2015", "1980s", "~1998", "C19", "late 1990s", "before 1950", "2010..2015". Empty for
/// other texts.
std::optional<Days> parse_days(std::string_view text);

}  // namespace nightcity::osm
