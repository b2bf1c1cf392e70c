// Options of the lights that are no street lamps.
#pragma once

#include <map>
#include <set>

#include "tools/map_lights/map_light_defaults.h"

namespace nightcity::map_lights {

struct MapLightOptions {
  bool lit = true;                                // false: there are none
  std::set<MapLightKind> without;                 // kinds that there are none of
  std::map<MapLightKind, lights::NightSpan> off;  // when a kind is dark, unless its tags say more

  bool makes(MapLightKind kind) const { return lit && !without.contains(kind); }
};

}  // namespace nightcity::map_lights
