// The stage of places: latitude and longitude, and names of streets.
#pragma once

#include "formats/scene_places.h"
#include "tools/bake/city/city.h"
#include "tools/bake/report/places_report.h"

namespace nightcity::bake {

struct PlacesOfCity {
  ScenePlaces places;
  PlacesReport report;
};

/// Returns the latitudes and longitudes of the rectangle that the city fills and of a margin around
/// it, and the names that the map has there.
PlacesOfCity find_places(const City& city, const terrain::Extent& extent,
                         const Georeference& georeference);

}  // namespace nightcity::bake
