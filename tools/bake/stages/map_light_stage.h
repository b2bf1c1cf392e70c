// The lights of a city's map that are no street lamps.
#pragma once

#include "tools/bake/city/city.h"
#include "tools/map_lights/place_map_lights.h"

namespace nightcity::bake {

/// Places the lights on the city's ground, before and in its buildings. A map without such things
/// gives none. Throws Error when there are some and the city has no CRS.
map_lights::MapLightSet place_city_map_lights(const City& city,
                                              const map_lights::MapLightOptions& options);

/// Appends the luminaires to those of `lamps`, with their profiles. Ids that lamps have already are
/// changed.
void add_luminaires(map_lights::MapLightSet& from, lights::LampSet& lamps);

}  // namespace nightcity::bake
