// The street lamps of a city: those that the map has, and laid-out ones where it has streets only.
#pragma once

#include "tools/bake/city/city.h"
#include "tools/bake/stages/lamp_options.h"
#include "tools/layout/layout.h"
#include "tools/lights/place_lamps.h"

namespace nightcity::bake {

struct CityLamps {
  lights::LampSet set;
  layout::LayoutReport layout;
};

/// Places the lamps on the city's ground. Without a city model a lamp stands at the height of its
/// tag `ele`, else at 0. Throws Error when a luminaire cannot be read, or when the map has lamps or
/// streets to be lit and the city no CRS.
CityLamps place_city_lamps(const City& city, const LampStageOptions& options);

}  // namespace nightcity::bake
