// Decides whether a thing of the map is there on a day.
#pragma once

#include "tools/osm/days.h"
#include "tools/osm/osm_data.h"

namespace nightcity::osm {

/// Returns whether something has been taken away by that day, or is not built yet: `demolished`,
/// `razed`, `removed`, `destroyed` or `dismantled` say yes or a date that is not ahead, `end_date`
/// is past, or `start_date` or `opening_date` is ahead. Dates that are not understood say nothing.
bool is_gone(const OsmTags& tags, Day day);

/// Returns whether something is there and not in use: `disused` or `abandoned` say so.
bool is_out_of_use(const OsmTags& tags, Day day);

}  // namespace nightcity::osm
