// Every light of the city: placed, shown in city.glb and written to city.lights.
#pragma once

#include <filesystem>
#include <optional>

#include "formats/scene_file.h"
#include "tools/bake/bake_report.h"
#include "tools/bake/city_frames.h"
#include "tools/bake/recipe.h"
#include "tools/lights/windows.h"
#include "tools/osm/osm_data.h"
#include "tools/terrain/terrain.h"

namespace nightcity {

/// `windows`: empty where the recipe wants none. Memory grows with the lamps, not with the windows.
/// Throws Error when the map has lamps and the city no CRS.
void bake_lights(const Recipe& recipe, const OsmData& osm, const CityFrames& frames, const Terrain& terrain,
                 std::optional<WindowLayout> windows, const Georeference& georeference, SceneWriter& writer,
                 const std::filesystem::path& lights_path, BakeReport& report);

}  // namespace nightcity
