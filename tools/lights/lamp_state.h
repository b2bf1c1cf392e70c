// Decides whether a mapped lamp exists and works today.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "tools/osm/days.h"
#include "tools/osm/osm_data.h"

namespace nightcity::lights {

using osm::Day;
using osm::Days;
using osm::parse_days;

/// Returns whether a thing lies below the ground or in a building, by its level, layer and
/// location.
bool is_below_ground(const osm::OsmTags& tags);

/// Returns why the lamp gives no light, in words for a report: "disused or demolished", "broken",
/// "end_date past", "start_date ahead", "underground". Empty for a lamp that works. Values of these
/// tags that are not understood are counted in `unread`.
std::string_view find_outage(const osm::OsmTags& tags, Day day,
                             std::map<std::string, std::size_t>& unread);

}  // namespace nightcity::lights
