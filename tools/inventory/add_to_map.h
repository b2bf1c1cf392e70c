// Joins inventories with the lamps of a map.
#pragma once

#include <vector>

#include "tools/inventory/inventory.h"
#include "tools/inventory/read_inventory.h"
#include "tools/osm/osm_data.h"

namespace nightcity::inventory {

/// Reads the files and puts their lamps before those of the map. A lamp of the map within a file's
/// within_m of one of its lamps is the same lamp and is taken out: a town knows its lamps better
/// than passers-by. Of two files that know a lamp the first wins likewise. Returns a report for
/// each file. Throws Error as read_inventory does.
std::vector<InventoryReport> add_to_map(const std::vector<InventoryFile>& files, osm::OsmData& map);

}  // namespace nightcity::inventory
