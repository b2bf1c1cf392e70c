// Blocks whose buildings stand apart from each other.
#pragma once

#include "tools/town/block_site.h"

namespace nightcity::town {

/// Plans one public building around a yard: town hall, school, museum. Houses where there is no
/// room.
void plan_courtyard(BlockSite& site);
/// Plans detached and semi-detached houses in gardens along all four sides.
void plan_houses(BlockSite& site);
/// Plans two long parallel blocks of flats with a lawn between. Houses where there is no room.
void plan_slabs(BlockSite& site);
/// Plans a supermarket or workshop behind its car park.
void plan_hall(BlockSite& site);

}  // namespace nightcity::town
