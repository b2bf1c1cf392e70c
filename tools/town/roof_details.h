// Dormers and chimneys: what makes a roof cast more than one shadow.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/city/city_model.h"
#include "tools/town/building_plan.h"

namespace nightcity::town {

struct RoofDetail {
  bool chimney = false;           // else a dormer
  std::vector<Polygon> surfaces;  // standing on the roof, open below; m from the town's origin
};

/// Details of one body; none on flat and shed roofs and on churches. `number` tells bodies of one seed apart.
std::vector<RoofDetail> roof_details(const BuildingPlan& plan, std::uint64_t seed,
                                     std::size_t number);

}  // namespace nightcity::town
