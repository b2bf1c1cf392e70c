// A city read for its ground and walls alone: what the stages ask that place lights without baking a scene.
#pragma once

#include <filesystem>
#include <optional>

#include "tools/bake/city/city_frames.h"
#include "tools/bake/progress.h"
#include "tools/bake/recipe/recipe.h"
#include "tools/bake/report/bake_report.h"
#include "tools/lights/windows.h"
#include "tools/osm/osm_data.h"
#include "tools/streets/road_surfaces.h"
#include "tools/terrain/terrain.h"

namespace nightcity {

/// Reads the recipe's city into `terrain`, which is built, and its buildings into `windows` where that holds
/// something, its roads into `roads`. What a bake would show goes to a scratch file and is forgotten. Throws
/// Error as bake() does.
void read_ground(const Recipe& recipe, const CityFrames& frames, Terrain& terrain,
                 std::optional<WindowLayout>& windows, const ProgressSink& progress,
                 streets::RoadSurfaces* roads = nullptr);

/// How windows are to be laid: by the recipe, with the uses that the map's buildings tell.
WindowOptions window_options(const Recipe& recipe, const OsmData& osm, const CityFrames& frames);

/// A recipe as in a file, or of the files themselves: CityGML and OSM, told apart by their content. Folders
/// stand for the CityGML in them. Throws Error for a file of another kind, UsageError where a recipe stands
/// among other files.
Recipe recipe_of(const std::vector<std::filesystem::path>& inputs);

/// Where lights of the recipe's inputs stand when no scene is made with them: the city's CRS, and as origin
/// the city's middle.
Georeference georeference_of(const Recipe& recipe, const CityFrames& frames);

}  // namespace nightcity
