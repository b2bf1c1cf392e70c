// The one table of road classes: what a value of OSM's `highway` tag says about a road that carries no
// further tags. What lamps make of a class is in tools/lights/lamp_defaults.h, what traffic makes of it in
// tools/traffic/road_classes.h.
#pragma once

#include <string_view>

namespace nightcity::roads {

/// How important a road is. Old lamp types came in three sizes, one for each tier.
enum class RoadTier { main = 0, local = 1, path = 2 };

struct RoadClass {
  const char* highway;  // value of the OSM tag
  RoadTier tier;
  double width_m;  // carriageway, where neither width nor lanes are tagged
};

/// Returns the row of a normalised highway value; a "_link" class has its main class's row. Null where
/// there is no road that people use (proposed, construction, raceway, ...).
const RoadClass* find_road_class(std::string_view highway);

}  // namespace nightcity::roads
