// Traffic in a bake: made from the map's streets, shown in city.glb and added to city.lights.
#pragma once

#include <filesystem>

#include "formats/scene_file.h"
#include "tools/bake/city_frames.h"
#include "tools/bake/progress.h"
#include "tools/bake/recipe.h"
#include "tools/osm/osm_data.h"
#include "tools/terrain/terrain.h"
#include "tools/traffic/traffic.h"

namespace nightcity {

/// As [traffic] of the recipe wants it. Throws Error when the map has streets and the city no CRS.
traffic::TrafficSet make_city_traffic(const Recipe& recipe, const OsmData& osm, const CityFrames& frames,
                                      const Terrain& terrain, const Georeference& georeference,
                                      const ProgressSink& progress);

/// Writes `source` with this traffic in place of any it has to `target`; the two may be one file. Throws
/// Error.
void put_traffic(const std::filesystem::path& source, const std::filesystem::path& target,
                 const traffic::TrafficSet& traffic);

/// Bodies of the kinds of vehicle that drive, as nodes of kind "vehicle", standing where they are at `t`
/// seconds since noon, or where their first drive begins when none is on the road.
void add_vehicle_models(SceneWriter& writer, const traffic::TrafficSet& traffic, double t);

}  // namespace nightcity
