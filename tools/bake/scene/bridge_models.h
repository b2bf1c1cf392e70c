// The bridges of the map in the scene: decks with what covers them, their sides and lower sides,
// railings and piers.
#pragma once

#include "tools/bake/city/city.h"
#include "tools/bake/report/bridge_report.h"
#include "tools/bake/scene/scene_tiles.h"

namespace nightcity::bake {

/// Adds all bridges to the tiles, and what they are to `report`.
void add_bridge_models(const City& city, SceneTiles& tiles, BridgesReport& report);

}  // namespace nightcity::bake
