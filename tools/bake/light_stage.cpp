#include "tools/bake/light_stage.h"

#include "tools/bake/lamp_models.h"
#include "tools/bake/lamp_stage.h"
#include "tools/bake/materials.h"
#include "tools/bake/window_models.h"

namespace nightcity {
namespace {

LampSet all_lamps(const Recipe& recipe, const OsmData& osm, const CityFrames& frames, const Terrain& terrain,
                  BakeReport& report) {
  CityLamps lamps = place_city_lamps(recipe, osm, frames, terrain);
  report.lamps.mapped = osm.lamps.size();
  report.lamps.placed = lamps.set.lamps.size();
  report.lamps.dropped = lamps.set.dropped;
  report.lamps.sources = lamps.set.sources;
  report.lamps.notes = lamps.set.notes;
  for (const PlacedLamp& lamp : lamps.set.lamps) report.lamps.total_flux_lm += lamp.flux_lm;
  report.layout = std::move(lamps.layout);
  return std::move(lamps.set);
}

std::vector<LitRectangle> lit_windows(std::optional<WindowLayout> layout, const Terrain& terrain, int minute,
                                      BakeReport& report) {
  if (!layout) return {};
  WindowSet set = std::move(*layout).finish(height_on(terrain));
  report.windows.dropped = set.dropped;
  report.windows.sources = set.sources;
  std::vector<LitRectangle> lit;
  for (const LitRectangle& window : set.windows) {
    if (!set.schedules[window.schedule].lit_at(minute)) {
      ++report.windows.dropped["dark at this time"];
      continue;
    }
    lit.push_back(window);
    report.windows.total_flux_lm += window.flux_lm();
  }
  report.windows.placed = lit.size();
  return lit;
}

}  // namespace

void bake_lights(const Recipe& recipe, const OsmData& osm, const CityFrames& frames, const Terrain& terrain,
                 std::optional<WindowLayout> windows, const Georeference& georeference, SceneWriter& writer,
                 const std::filesystem::path& lights_path, BakeReport& report) {
  const LampSet lamps = all_lamps(recipe, osm, frames, terrain, report);
  const auto lit = lit_windows(std::move(windows), terrain, recipe.night.minute, report);

  // Lamps first, then windows: the models name their lights by this order.
  std::vector<Light> lights;
  std::vector<LightProvenance> provenance;
  for (const PlacedLamp& lamp : lamps.lamps) {
    lights.push_back(to_light(lamp, georeference));
    provenance.push_back(lamp.provenance);
  }
  for (const LitRectangle& window : lit) {
    lights.push_back(to_light(window, georeference));
    provenance.push_back(window.provenance);
  }
  add_lamp_models(writer, lamps.lamps, georeference, static_cast<std::uint32_t>(BakeMaterial::lamp_post));
  add_window_models(writer, lit, static_cast<std::uint32_t>(lamps.lamps.size()), georeference,
                    recipe.city.tile_m);
  write_light_file(lights_path, {georeference, lights, provenance, lamps.profiles, lamps.profile_data});
}

}  // namespace nightcity
