// Writes the town's OSM extract: its streets, and street lamps tagged as sparsely and variously as
// people do it.
#pragma once

#include <cstddef>
#include <cstdint>

#include "tools/town/street_plan.h"
#include "tools/town/text_file.h"
#include "tools/town/town.h"

namespace nightcity::town {

/// Writes a whole OSM XML document; returns the number of luminaires.
std::size_t write_osm(TextFile& out, const StreetPlan& streets, const TownOptions& options);

}  // namespace nightcity::town
