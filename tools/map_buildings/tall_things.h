// Things of a map that stand as buildings do and have no tag that says so: chimneys, tanks, towers.
#pragma once

#include <optional>
#include <string>

#include "tools/map_buildings/file_buildings.h"
#include "tools/osm/map_areas.h"

namespace nightcity::map_buildings {

/// Returns whether tags say that something is a building or a part of one.
bool says_building(const osm::OsmTags& tags);

/// Returns what a thing is that stands as buildings do without being one, "chimney", say; "" for
/// anything else.
std::string find_tall_kind(const osm::OsmTags& tags);

/// Returns the function of such a thing, which has no rooms; "" for anything else.
std::string name_tall_function(const osm::OsmTags& tags);

/// Returns a node as a round outline, if it is such a thing and says how wide and how high it is.
std::optional<osm::MapArea> make_round_outline(const osm::MapPoint& point);

/// Leaves those out, and counts them, that a building or another of them stands for, that are of
/// bars and ropes, and towers without a height.
void leave_out_tall_things(FileBuildings& of);

}  // namespace nightcity::map_buildings
