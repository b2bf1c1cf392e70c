#include "tools/bake/stages/light_stage.h"

#include "tools/bake/scene/lamp_models.h"
#include "tools/bake/scene/light_places.h"
#include "tools/bake/scene/materials.h"
#include "tools/bake/scene/punctual.h"
#include "tools/bake/scene/window_models.h"
#include "tools/bake/stages/lamp_stage.h"

namespace nightcity {
namespace {

// A tile's windows come in a hundred looks, a primitive each: of the size of other tiles, a city's JSON would
// be a fifth of its file.
constexpr double tiles_a_batch = 4;  // along a side

}  // namespace

ScheduleTable schedules_of(LightFileWriter& lights) {
  return ScheduleTable(
      [&lights](std::span<const uint> switches) { return lights.add_schedule(switches); });
}

LampProfiles bake_lights(const Recipe& recipe, const OsmData& osm, const CityFrames& frames,
                         const Terrain& terrain, std::optional<WindowLayout> windows,
                         const Georeference& georeference, SceneWriter& writer,
                         LightFileWriter& lights, const std::filesystem::path& scratch,
                         BakeReport& report) {
  CityLamps placed = place_city_lamps(recipe, osm, frames, terrain);
  LampSet& lamps = placed.set;
  report.lamps = report_of(lamps, osm.lamps.size());
  report.layout = std::move(placed.layout);
  ScheduleTable schedules = schedules_of(lights);
  BrightestLights brightest(recipe.output.punctual);
  // Lamps first, then windows: the models name their lights by this order.
  for (const PlacedLamp& lamp : lamps.lamps) {
    const Light light = to_light(lamp, georeference, schedules);
    lights.add(light, lamp.provenance);
    if (!lamp.hours || lamp.hours->lit_at(recipe.night.minute)) brightest.add(light);
  }
  add_lamp_models(writer, lamps.lamps, georeference,
                  static_cast<std::uint32_t>(BakeMaterial::lamp_post));
  lamps.lamps = {};
  if (windows) {
    WindowModels models(scratch, tiles_a_batch * recipe.city.tile_m);
    const auto inside = [&](const glm::dvec3& place) { return inside_building(terrain, place); };
    const auto place = [&](const LitRectangle& window) {
      const Light light = to_light(window, georeference, schedules);
      models.add(window, lights.add(light, window.provenance));
      if (window.hours.lit_at(recipe.night.minute)) brightest.add(light);
    };
    report.windows =
        std::move(*windows).finish(height_on(terrain), place, inside, recipe.city.read.threads);
    models.write(writer, georeference);
  }
  for (const Light& light : std::move(brightest).take())
    writer.add_punctual(punctual_of(light, lamps.profiles, lamps.profile_data));
  report.schedules = schedules.size();
  return {std::move(lamps.profiles), std::move(lamps.profile_data)};
}

}  // namespace nightcity
