// Uses of buildings by the city's map.
#pragma once

#include <vector>

#include "tools/bake/city/city.h"
#include "tools/lights/building_use.h"
#include "tools/osm/map_areas.h"

namespace nightcity::bake {

/// Returns the use that the city's map gives at a place, for lights::use_of(); an empty function
/// where the map has no buildings. The function does not need the city any more.
lights::UseAt make_use_finder(const City& city);

/// Reads the buildings of the inputs' maps that are multipolygons and whose tags say a use. `map`
/// says whether there are any. Throws Error: a map is missing or broken.
std::vector<osm::MapArea> read_building_multipolygons(const CityInputs& inputs,
                                                      const osm::OsmData& map);

}  // namespace nightcity::bake
