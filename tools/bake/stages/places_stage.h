// What a scene's user may ask for by words: latitude and longitude, names of streets.
#pragma once

#include "formats/scene_places.h"
#include "tools/bake/city/city.h"
#include "tools/bake/report/places_report.h"

namespace nightcity::bake {

struct PlacesOfCity {
  ScenePlaces places;
  PlacesReport report;
};

/// Returns the latitudes and longitudes of the city's ground and of a margin around it, and the
/// names that the map has there. Call it when the ground has been built.
PlacesOfCity find_places(const City& city, const Georeference& georeference);

}  // namespace nightcity::bake
