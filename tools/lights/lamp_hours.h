// Lamps that towns switch off in the middle of the night, by class of road.
#pragma once

#include <map>
#include <string>

#include "tools/lights/place_lamps.h"

namespace nightcity {

struct LampHours {
  std::map<std::string, NightSpan> off;         // highway value: every lamp is dark in between
  std::map<std::string, NightSpan> half_night;  // every second one along each way is
};

/// Gives hours to the lamps whose tags tell none and whose road is in `hours`, and counts where each lamp's
/// hours came from in set.sources. The lamps of a way are told apart by their place along it, so the same
/// ones stay on whatever else is in the map.
void switch_lamps(const LampHours& hours, LampSet& set);

}  // namespace nightcity
