// The places of a city where nothing of a map is put: in buildings, and below bridges.
#pragma once

#include "tools/bake/city/city.h"

namespace nightcity::bake {

/// Returns where neither trees, barriers nor steps stand. The city must outlive the result.
place::InsideBuilding find_obstacles(const City& city);

}  // namespace nightcity::bake
