// The church on the market square.
#pragma once

#include "tools/town/block_site.h"

namespace nightcity::town {

/// Plans the church: nave, west tower, apse in the east.
void plan_church(BlockSite& site);

}  // namespace nightcity::town
