// Switches lamps off in the middle of the night, as towns do, by class of road.
#pragma once

#include <map>
#include <string>

#include "tools/lights/place_lamps.h"

namespace nightcity::lights {

struct LampHours {
  // By highway value: the time in which every lamp is dark, or every second lamp along each way.
  std::map<std::string, NightSpan> off, half_night;
};

/// Sets the hours of lamps whose tags give none and whose road is in `hours`, and counts in
/// set.sources where the hours of each lamp come from. The lamps of a way are numbered by their
/// place along it, so which of them stay on does not depend on the rest of the map.
void switch_lamps(const LampHours& hours, LampSet& set);

}  // namespace nightcity::lights
