// Who may enter a junction, and when.
#pragma once

#include "tools/traffic/road_state.h"

namespace nightcity::traffic {

/// Whether a car may drive the turn that is its leg `leg`: room behind it, nobody who holds a turn across it
/// hindered, nobody hindered to whom it gives way. More holders never turn a no into a yes: who is refused at
/// one moment is refused whatever else is granted in it.
bool may_go(const RoadState& roads, std::uint32_t number, std::size_t leg);

/// Tells every car whether it may drive the turns before it. Decided in the order of `active`, whatever the
/// number of threads.
void grant_turns(RoadState& roads);

}  // namespace nightcity::traffic
