// Traffic in a bake: made from the map's streets, shown in city.glb and added to city.lights.
#pragma once

#include <filesystem>

#include "formats/light_file_writer.h"
#include "formats/scene_file.h"
#include "tools/bake/city/city_frames.h"
#include "tools/bake/progress.h"
#include "tools/bake/recipe/recipe.h"
#include "tools/osm/osm_data.h"
#include "tools/terrain/terrain.h"
#include "tools/traffic/traffic.h"

namespace nightcity {

/// As [traffic] of the recipe wants it. Throws Error when the map has streets and the city no CRS.
traffic::TrafficSet make_city_traffic(const Recipe& recipe, const OsmData& osm,
                                      const CityFrames& frames, const Terrain& terrain,
                                      const Georeference& georeference,
                                      const ProgressSink& progress);

/// The same for a map without a city, on a plane at height 0: for a look at what streets can bear.
traffic::TrafficSet make_map_traffic(const Recipe& recipe, const OsmData& osm,
                                     const CityFrame& frame, const Georeference& georeference,
                                     const ProgressSink& progress);

/// All that a light file holds, to be written again; spans into `file`.
LightFileContent content_of(const LightFile& file);

/// Ends a light file with this traffic in it, in place of any that `rest` has. The vehicles' profiles follow
/// those of `rest`. Throws Error.
void finish_with_traffic(LightFileWriter& lights, LightFileContent rest,
                         const traffic::TrafficSet& traffic);

/// Writes `content` with this traffic in place of any it has. It may lie in the file that is replaced. Throws
/// Error.
void write_with_traffic(const std::filesystem::path& path, LightFileContent content,
                        const traffic::TrafficSet& traffic);

/// Bodies of the kinds of vehicle that drive, as nodes of kind "vehicle", standing where they are at `t`
/// seconds since noon, or where their first drive begins when none is on the road.
void add_vehicle_models(SceneWriter& writer, const traffic::TrafficSet& traffic, double t);

}  // namespace nightcity
