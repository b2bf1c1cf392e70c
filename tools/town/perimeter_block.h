// Blocks with houses wall to wall around a yard.
#pragma once

#include "tools/town/block_site.h"

namespace nightcity::town {

/// Plans the houses and the one in the yard. Returns false, without plans, where the block is too
/// small or too skew.
bool plan_perimeter(BlockSite& site);

}  // namespace nightcity::town
