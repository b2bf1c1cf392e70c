#include "tools/bake/stages/light_stage.h"

#include <utility>

#include "tools/bake/scene/lamp_models.h"
#include "tools/bake/scene/materials.h"
#include "tools/bake/scene/punctual.h"
#include "tools/bake/scene/window_models.h"
#include "tools/bake/stages/edited_lights.h"

namespace nightcity::bake {
namespace {

// A tile's windows come in a hundred looks, a primitive each: in tiles as small as the others, a
// city's JSON would be a fifth of its file.
constexpr double tiles_a_batch = 4;  // along a side

// Returns a table whose new schedules are written to `lights` one by one.
lights::ScheduleTable make_schedules(LightFileWriter& lights) {
  return lights::ScheduleTable(
      [&lights](std::span<const uint> switches) { return lights.add_schedule(switches); });
}

}  // namespace

BakedLights bake_lights(const City& city, WindowConsumer* windows, const LightStageOptions& options,
                        const LightOutputs& outputs) {
  const Georeference& georeference = outputs.georeference;
  BakedLights result;
  EditedLights edits(options.edits, outputs.lights);
  CityLamps placed = place_city_lamps(city, options.lamps);
  lights::LampSet& lamps = placed.set;
  result.report.lamps = to_report(lamps, city);
  result.report.layout = std::move(placed.layout);
  result.report.lamps.dark = explain_darkness(city, result.report);
  lights::ScheduleTable schedules = make_schedules(outputs.lights);
  BrightestLights brightest(options.punctual);
  // Lamps first, then windows: the models name their lights by this order.
  for (lights::PlacedLamp& lamp : lamps.lamps) {
    edits.change(lamp);
    Light light = lights::to_light(lamp, georeference, schedules);
    edits.finish(light);
    outputs.lights.add(light, lamp.provenance);
    if (edits.is_off(lamp.id)) continue;
    if (!lamp.hours || lamp.hours->lit_at(options.shown_minute)) brightest.add(light);
  }
  add_lamp_models(outputs.scene, lamps.lamps, georeference,
                  static_cast<std::uint32_t>(BakeMaterial::lamp_post));
  lamps.lamps = {};
  if (windows) {
    WindowModels models(outputs.scratch, tiles_a_batch * options.tile_m);
    result.report.windows = windows->finish(city, [&](lights::LitRectangle window) {
      edits.change(window);
      Light light = lights::to_light(window, georeference, schedules);
      edits.finish(light);
      models.add(window, outputs.lights.add(light, window.provenance));
      if (!edits.is_off(window.id) && window.hours.lit_at(options.shown_minute))
        brightest.add(light);
    });
    models.write(outputs.scene, georeference);
  }
  if (edits.used() > 0) result.report.lamps.notes["lights changed by edits"] = edits.used();
  if (edits.unused() > 0)
    result.report.lamps.notes["edits of lights that are not there"] = edits.unused();
  for (const Light& light : std::move(brightest).take())
    outputs.scene.add_punctual(to_punctual(light, lamps.profiles, lamps.profile_data));
  result.report.schedules = schedules.size();
  result.profiles = std::move(lamps.profiles);
  result.profile_data = std::move(lamps.profile_data);
  return result;
}

void write_lamp_lights(const std::filesystem::path& path, const lights::LampSet& lamps,
                       const Georeference& georeference) {
  LightFileWriter lights(path);
  lights::ScheduleTable schedules = make_schedules(lights);
  for (const lights::PlacedLamp& lamp : lamps.lamps)
    lights.add(lights::to_light(lamp, georeference, schedules), lamp.provenance);
  lights.finish({.georeference = georeference,
                 .profiles = lamps.profiles,
                 .profile_data = lamps.profile_data});
}

LightsReport write_window_lights(LightFileWriter& lights, const City& city,
                                 WindowConsumer& windows) {
  const Georeference georeference = city.georeference();
  LightsReport report;
  lights::ScheduleTable schedules = make_schedules(lights);
  report.windows = windows.finish(city, [&](const lights::LitRectangle& window) {
    lights.add(lights::to_light(window, georeference, schedules), window.provenance);
  });
  lights.finish({.georeference = georeference});
  report.schedules = schedules.size();
  return report;
}

}  // namespace nightcity::bake
