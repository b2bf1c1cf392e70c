// The street lamps of a city: those the map has, and laid-out ones where it has streets only.
#pragma once

#include "tools/bake/city_frames.h"
#include "tools/bake/recipe.h"
#include "tools/layout/layout.h"
#include "tools/lights/lamps.h"
#include "tools/osm/osm_data.h"
#include "tools/terrain/terrain.h"

namespace nightcity {

struct CityLamps {
  LampSet set;
  layout::LayoutReport layout;
};

/// Height of what one may stand on, for the stages that ask by place. Refers to `terrain`.
HeightAt height_on(const Terrain& terrain);

/// Throws Error when the map has lamps or streets to be lit and the city no CRS.
CityLamps place_city_lamps(const Recipe& recipe, const OsmData& osm, const CityFrames& frames,
                           const Terrain& terrain);

}  // namespace nightcity
