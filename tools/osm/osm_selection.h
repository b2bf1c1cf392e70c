// Which OSM elements a night scene wants. Spelling as people write it: case, hyphens and blanks do not
// matter.
#pragma once

#include <string>
#include <string_view>

#include "tools/osm/osm_data.h"

namespace nightcity {

/// A lamp that lights its surroundings: highway=street_lamp (and its misspellings),
/// light_source=lantern|floodlight| street_lamp|lamp|electric_lamp, tower:type=lighting,
/// man_made=street_lamp|floodlight|light_mast... Not signals, beacons and warning lights.
bool is_lamp(const OsmTags& tags);

bool is_highway(const OsmTags& tags);   // any highway=* that can be a way
bool is_building(const OsmTags& tags);  // building=* but "no"

}  // namespace nightcity
