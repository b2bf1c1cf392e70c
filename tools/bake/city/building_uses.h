// Uses of buildings by the city's map.
#pragma once

#include "tools/bake/city/city.h"
#include "tools/lights/building_use.h"

namespace nightcity::bake {

/// Returns the use that the city's map gives at a place, for lights::use_of(); an empty function
/// where the map has no buildings. The function does not need the city any more.
lights::UseAt make_use_finder(const City& city);

}  // namespace nightcity::bake
