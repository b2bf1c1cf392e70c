// Streets where no map tells them: out of the city model's own roads.
#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "tools/bake/city/city_frames.h"
#include "tools/bake/recipe/recipe.h"
#include "tools/osm/osm_data.h"
#include "tools/streets/street_ways.h"

namespace nightcity {

/// Whether the model's roads are to be gathered while it is read: something goes along streets and the map
/// has none.
bool wants_model_streets(const Recipe& recipe, const OsmData& osm, const CityFrames& frames);

struct StreetReport {
  std::size_t surfaces = 0;
  std::map<std::string, std::size_t> left_out;  // polygons, by reason
  std::map<std::string, double> km;             // by highway
  double km_by_code = 0;
  std::size_t junctions = 0, ends = 0;
};

/// Adds the streets as ways of the map.
StreetReport add_model_streets(const streets::RoadSurfaces& roads, const CityFrames& frames,
                               OsmData& osm);

nlohmann::json to_json(const StreetReport& report);
/// "" where the model has no roads.
std::string to_text(const StreetReport& report);

}  // namespace nightcity
