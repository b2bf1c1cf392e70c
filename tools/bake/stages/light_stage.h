// Every light of the city: placed, shown in city.glb and written to city.lights.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "formats/light_file_writer.h"
#include "formats/scene_file.h"
#include "tools/bake/city/city_frames.h"
#include "tools/bake/recipe/recipe.h"
#include "tools/bake/report/bake_report.h"
#include "tools/lights/night_schedule.h"
#include "tools/lights/windows.h"
#include "tools/osm/osm_data.h"
#include "tools/terrain/terrain.h"

namespace nightcity {

/// The schedules of lights that go into `lights` one by one.
ScheduleTable schedules_of(LightFileWriter& lights);

/// What the caller finishes a file of lights with.
struct LampProfiles {
  std::vector<LightProfile> profiles;
  std::vector<float> data;
};

/// `windows`: empty where the recipe wants none; they wait in a file beside `scratch`. Memory grows with the
/// lamps, not with the windows. Throws Error when the map has lamps and the city no CRS.
LampProfiles bake_lights(const Recipe& recipe, const OsmData& osm, const CityFrames& frames,
                         const Terrain& terrain, std::optional<WindowLayout> windows,
                         const Georeference& georeference, SceneWriter& writer,
                         LightFileWriter& lights, const std::filesystem::path& scratch,
                         BakeReport& report);

}  // namespace nightcity
