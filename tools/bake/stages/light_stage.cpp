#include "tools/bake/stages/light_stage.h"

#include <utility>

#include "formats/free_memory.h"
#include "tools/bake/scene/lamp_models.h"
#include "tools/bake/scene/materials.h"
#include "tools/bake/scene/punctual.h"
#include "tools/bake/scene/sign_models.h"
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
  map_lights::MapLightSet others = place_city_map_lights(city, options.map_lights);
  result.report.map_lights = others.report;
  add_luminaires(others, lamps);
  lights::ScheduleTable schedules = make_schedules(outputs.lights);
  BrightestLights brightest(options.punctual);
  // Luminaires first, then signs and windows: the models name their lights by this order.
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
  free_memory(lamps.lamps);
  const auto write_rectangle = [&](lights::LitRectangle rectangle, WindowModels& models) {
    edits.change(rectangle);
    Light light = lights::to_light(rectangle, georeference, schedules);
    edits.finish(light);
    models.add(rectangle, outputs.lights.add(light, rectangle.provenance));
    if (!edits.is_off(rectangle.id) && rectangle.hours.lit_at(options.shown_minute))
      brightest.add(light);
  };
  const double batch_m = tiles_a_batch * options.tile_m;
  if (!others.signs.empty()) {
    WindowModels models(outputs.scratch, batch_m, {"signs", "sign", "lit sign"});
    for (const lights::LitRectangle& sign : others.signs) write_rectangle(sign, models);
    models.write(outputs.scene, georeference);
  }
  add_sign_bodies(outputs.scene, others.bodies, georeference,
                  static_cast<std::uint32_t>(BakeMaterial::furniture));
  if (windows) {
    WindowModels models(outputs.scratch, batch_m, {.material = windows->material_name()});
    result.report.windows = windows->finish(
        city, [&](const lights::LitRectangle& window) { write_rectangle(window, models); });
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
