// Dormers and chimneys.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/city/city_model.h"
#include "tools/town/building_plan.h"

namespace nightcity::town {

struct RoofDetail {
  bool chimney = false;  // else a dormer
  std::vector<city::Polygon>
      surfaces;  // standing on the roof, open below; m from the town's origin
};

/// Returns the details of one body: none on flat and shed roofs and on churches. `number` makes
/// bodies of one seed differ.
std::vector<RoofDetail> make_roof_details(const BuildingPlan& plan, std::uint64_t seed,
                                          std::size_t number);

}  // namespace nightcity::town
