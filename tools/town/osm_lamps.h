// Writes the town's street lamps, tagged as sparsely and variously as people do it.
#pragma once

#include <cstddef>

#include "tools/town/osm_elements.h"
#include "tools/town/street_plan.h"

namespace nightcity::town {

/// Writes a node for each post along the streets; returns the number of luminaires.
std::size_t write_lamps(OsmElements& out, const StreetPlan& streets, const TownOptions& options);

}  // namespace nightcity::town
