// Buildings that a map has twice, as imports and slips of mappers leave them.
#pragma once

#include <cstddef>
#include <vector>

#include "tools/osm/days.h"
#include "tools/osm/map_areas.h"

namespace nightcity::map_buildings {

/// Returns for each building the number of the one that stands for it: of those with the same
/// corners, foot and layer the one with the most tags, of these that of the first id; else its own.
/// A building that is not there on the day stands for itself alone. The order of buildings does not matter.
std::vector<std::size_t> find_standing(const std::vector<osm::MapArea>& buildings, osm::Day day);

}  // namespace nightcity::map_buildings
