// Lamps on bridges and below them.
#pragma once

#include "tools/bake/city/city_bridges.h"
#include "tools/lights/place_lamps.h"

namespace nightcity::bake {

/// Moves the lamps beside ways on bridges onto their decks. Those below a deck hang lower where
/// they would stand through it, or are left out where there is no room; both are counted.
void place_on_bridges(const CityBridges& bridges, lights::LampSet& lamps);

}  // namespace nightcity::bake
