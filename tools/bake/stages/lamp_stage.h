// The street lamps of a city: those the map has, and laid-out ones where it has streets only.
#pragma once

#include "tools/bake/city/city_frames.h"
#include "tools/bake/recipe/recipe.h"
#include "tools/layout/layout.h"
#include "tools/lights/lamps.h"
#include "tools/osm/osm_data.h"
#include "tools/terrain/terrain.h"

namespace nightcity {

struct CityLamps {
  LampSet set;
  layout::LayoutReport layout;
};

/// Height of what one may stand on (no roof), for the stages that ask by place. Refers to `terrain`.
HeightAt height_on(const Terrain& terrain);

/// The recipe's luminaires, read. Throws Error with file and line.
LampOptions lamp_options(const Recipe::Lamps& lamps);

/// Throws Error when the map has lamps or streets to be lit and the city no CRS.
CityLamps place_city_lamps(const Recipe& recipe, const OsmData& osm, const CityFrames& frames,
                           const Terrain& terrain);

/// A frame for the lamps of a map without a city: the UTM zone of their middle. Throws Error where the map
/// has no lamp and no street.
struct MapFrame {
  explicit MapFrame(const OsmData& osm);
  Georeference georeference(const Recipe& recipe) const;

  glm::dvec2 middle{0, 0};  // longitude, latitude
  CityFrame frame;
};

/// The map's lamps at the height of their `ele` tags, else at 0.
CityLamps place_map_lamps(const Recipe& recipe, const OsmData& osm, const CityFrame& frame);

}  // namespace nightcity
