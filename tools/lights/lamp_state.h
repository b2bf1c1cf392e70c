// Decides whether a mapped lamp exists and works today.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "tools/osm/osm_data.h"

namespace nightcity::lights {

using Day = std::chrono::sys_days;

struct Days {
  Day first, last;
};

/// Returns the first and last day of a date of OSM (its wiki, "Key:start_date"): "2015-05-01",
/// "2015-05", "2015", "1980s", "~1998", "C19", "late 1990s", "before 1950", "2010..2015". Empty for
/// other texts.
std::optional<Days> parse_days(std::string_view text);

/// Returns why the lamp gives no light, in words for a report: "disused or demolished", "broken",
/// "end_date past", "start_date ahead", "underground". Empty for a lamp that works. Values of these
/// tags that are not understood are counted in `unread`.
std::string_view find_outage(const osm::OsmTags& tags, Day day,
                             std::map<std::string, std::size_t>& unread);

}  // namespace nightcity::lights
