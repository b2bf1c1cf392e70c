// Decides which vehicles may enter a junction, and when.
#pragma once

#include "tools/traffic/road_state.h"

namespace nightcity::traffic {

/// Returns whether a vehicle may drive the turn that is its leg `leg`. All of this must hold:
/// - the lane behind the turn has room for the vehicle;
/// - it hinders no vehicle that holds a conflicting turn;
/// - it hinders no vehicle to which it has to give way.
/// Monotone: granting more turns never makes a refused turn acceptable. So the order of the
/// requests of one moment only matters for those that are accepted at first.
bool may_go(const RoadState& roads, std::uint32_t number, std::size_t leg);

/// Grants turns to the vehicles that reach them. Requests are decided in the order of `active`, so
/// the result does not depend on the number of threads.
void grant_turns(RoadState& roads);

}  // namespace nightcity::traffic
