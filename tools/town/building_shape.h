// From a building's plan to its boundary surfaces: closed, planar, seen counter-clockwise from outside.
#pragma once

#include <vector>

#include "tools/city/city_model.h"
#include "tools/town/building_plan.h"

namespace nightcity::town {

/// Ground, walls and roof of one body (not of its parts); coordinates in metres from the town's origin.
std::vector<Polygon> surfaces_of(const BuildingPlan& plan);

}  // namespace nightcity::town
