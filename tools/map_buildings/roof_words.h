// The words that mappers have for shapes of roofs.
#pragma once

#include "tools/city/skip_counter.h"
#include "tools/map_buildings/building_tags.h"
#include "tools/osm/osm_data.h"

namespace nightcity::map_buildings {

/// Returns the shape that `roof:shape` or `building:roof:shape` names, of a list the first. Shapes
/// that are shown as another one, or flat, are counted.
RoofShape find_roof_shape(const osm::OsmTags& tags, city::SkipCounter& notes);

}  // namespace nightcity::map_buildings
