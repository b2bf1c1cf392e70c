// How fast to drive: the Intelligent Driver Model behind the one ahead, and what bends and lines allow.
#pragma once

#include "tools/traffic/road_state.h"

namespace nightcity::traffic {

/// Sets next_v of every car, from one moment for all of them.
void choose_speeds(RoadState& roads);

}  // namespace nightcity::traffic
