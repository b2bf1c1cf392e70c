// Merges lamps that stand near each other, for cities with more of them than a scene can hold.
#pragma once

#include <cstddef>

#include "tools/lights/place_lamps.h"

namespace nightcity::lights {

/// Merges each lamp into a stronger one of its kind within `distance_m` (between feet, in plan),
/// and returns how many are gone. Of a kind are lamps with one distribution, colour and hours,
/// whose aims differ by less than 60 degrees. The strongest come first: such a lamp takes in all
/// those around it that no other has taken. It keeps its place, height and aim, gets the sum of
/// their fluxes, and grows so that its luminance is the mean one of its lamps. The order of the
/// others stays.
std::size_t merge_lamps(double distance_m, LampSet& set);

}  // namespace nightcity::lights
