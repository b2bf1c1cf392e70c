// The speeds of vehicles: the Intelligent Driver Model behind the vehicle ahead, and what bends and
// stop lines allow.
#pragma once

#include "tools/traffic/road_state.h"

namespace nightcity::traffic {

/// Sets next_v of every vehicle on the road, for all of them from the state of the same moment.
void choose_speeds(RoadState& roads);

}  // namespace nightcity::traffic
