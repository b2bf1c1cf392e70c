// Trees in parks, gardens and yards, away from the lamps, which stand on the pavements and along
// the paths.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "tools/city/city_model.h"
#include "tools/town/building_plan.h"
#include "tools/town/hills.h"
#include "tools/town/street_plan.h"

namespace nightcity::town {

struct TreePlan {
  glm::dvec2 foot{0};
  double ground_m = 0, height_m = 8, crown_radius_m = 2;
};

/// Returns the trees of block (i, j). Their crowns keep clear of the block's houses, kerbs and park
/// path.
std::vector<TreePlan> plan_trees(const StreetPlan& streets, const Hills& hills,
                                 const std::vector<BuildingPlan>& houses, std::uint64_t seed, int i,
                                 int j);

/// Returns trunk and crown, 32 triangles.
std::vector<city::Ring> make_tree_surfaces(const TreePlan& tree);

}  // namespace nightcity::town
