// The static lights of the city: placed, shown in city.glb and written to city.lights.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "formats/light_file_writer.h"
#include "formats/scene_writer.h"
#include "tools/bake/city/city.h"
#include "tools/bake/report/light_report.h"
#include "tools/bake/stages/lamp_stage.h"
#include "tools/bake/stages/map_light_stage.h"
#include "tools/bake/stages/window_stage.h"
#include "tools/lights/night_schedule.h"

namespace nightcity::bake {

struct LightStageOptions {
  LampStageOptions lamps;
  map_lights::MapLightOptions map_lights;
  int shown_minute = 5 * 60;  // after 17:00: the time that KHR_lights_punctual shows
  std::size_t punctual = 0;   // how many of the brightest lights are written as KHR_lights_punctual
  double tile_m = 250;        // side of the scene's tiles
  std::vector<std::filesystem::path> edits;  // files of edited lights
};

/// The files that the lights are written to.
struct LightOutputs {
  SceneWriter& scene;
  LightFileWriter& lights;  // gets lights and schedules; the caller finishes it
  const Georeference& georeference;
  std::filesystem::path scratch;  // scratch files lie beside it
};

/// The profiles, with which the caller finishes the file of lights, and the report.
struct BakedLights {
  std::vector<LightProfile> profiles;
  std::vector<float> profile_data;
  LightsReport report;
};

/// Writes the lamps, then the other lights of the map, then the windows that `windows` has gathered
/// (null: none). Memory grows with the lamps, not with the windows. Throws Error when the map has
/// lamps and the city no CRS.
BakedLights bake_lights(const City& city, WindowConsumer* windows, const LightStageOptions& options,
                        const LightOutputs& outputs);

/// Writes lamps alone to a light file. Throws Error.
void write_lamp_lights(const std::filesystem::path& path, const lights::LampSet& lamps,
                       const Georeference& georeference);

/// Writes the windows that `windows` has gathered, and nothing else, to a light file that is open.
/// Throws Error.
LightsReport write_window_lights(LightFileWriter& lights, const City& city,
                                 WindowConsumer& windows);

}  // namespace nightcity::bake
