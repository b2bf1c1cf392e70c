#include "tools/bake/light_stage.h"

#include "formats/light_file_writer.h"
#include "tools/bake/lamp_models.h"
#include "tools/bake/lamp_stage.h"
#include "tools/bake/light_places.h"
#include "tools/bake/materials.h"
#include "tools/bake/punctual.h"
#include "tools/bake/window_models.h"

namespace nightcity {
void bake_lights(const Recipe& recipe, const OsmData& osm, const CityFrames& frames, const Terrain& terrain,
                 std::optional<WindowLayout> windows, const Georeference& georeference, SceneWriter& writer,
                 const std::filesystem::path& lights_path, BakeReport& report) {
  CityLamps placed = place_city_lamps(recipe, osm, frames, terrain);
  const LampSet& lamps = placed.set;
  report.lamps = report_of(lamps, osm.lamps.size());
  report.layout = std::move(placed.layout);
  ScheduleTable schedules;
  LightFileWriter lights(lights_path);
  BrightestLights brightest(recipe.output.punctual);
  // Lamps first, then windows: the models name their lights by this order.
  for (const PlacedLamp& lamp : lamps.lamps) {
    const Light light = to_light(lamp, georeference, schedules);
    lights.add(light, lamp.provenance);
    if (!lamp.hours || lamp.hours->lit_at(recipe.night.minute)) brightest.add(light);
  }
  add_lamp_models(writer, lamps.lamps, georeference, static_cast<std::uint32_t>(BakeMaterial::lamp_post));
  if (windows) {
    WindowModels models(lights_path, recipe.city.tile_m);
    const auto inside = [&](const glm::dvec3& place) { return inside_building(terrain, place); };
    const auto place = [&](const LitRectangle& window) {
      const Light light = to_light(window, georeference, schedules);
      models.add(window, lights.add(light, window.provenance));
      if (window.hours.lit_at(recipe.night.minute)) brightest.add(light);
    };
    report.windows = std::move(*windows).finish(height_on(terrain), place, inside);
    models.write(writer, georeference);
  }
  for (const Light& light : std::move(brightest).take())
    writer.add_punctual(punctual_of(light, lamps.profiles, lamps.profile_data));
  report.schedules = schedules.schedules().size();
  LightFileContent rest;
  rest.georeference = georeference;
  rest.profiles = lamps.profiles;
  rest.profile_data = lamps.profile_data;
  rest.schedules = schedules.schedules();
  rest.switches = schedules.switches();
  lights.finish(rest);
}

}  // namespace nightcity
