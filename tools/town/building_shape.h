// Turns a building's plan into its boundary surfaces: closed, planar, counter-clockwise seen from
// outside.
#pragma once

#include <vector>

#include "tools/city/city_model.h"
#include "tools/town/building_plan.h"

namespace nightcity::town {

/// Returns ground, walls and roof of one body without its parts, in metres from the town's origin.
std::vector<city::Polygon> make_surfaces(const BuildingPlan& plan);

}  // namespace nightcity::town
