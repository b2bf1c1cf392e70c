// Keeps small maps from large bills: streets that meet in one place cost the square of their number.
#pragma once

#include <cstddef>
#include <vector>

#include "tools/osm/osm_data.h"

namespace nightcity::osm {

/// Removes each street or track that goes through a place where `max_streets_at_node` of those before it do,
/// each as often as it does, and returns how many were removed. Places are those of OSM's
/// resolution.
std::size_t leave_out_crowded(std::vector<OsmWay>& streets);

}  // namespace nightcity::osm
