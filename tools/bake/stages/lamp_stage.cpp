#include "tools/bake/stages/lamp_stage.h"

#include <filesystem>
#include <map>
#include <string>

#include "tools/bake/stages/lamps_on_bridges.h"
#include "tools/lights/luminaire.h"
#include "tools/lights/merge_lamps.h"

namespace nightcity::bake {
namespace {

// Adds to `notes` what the files name and is not used. Several rows may name one file, for other
// lamps each: it is read once.
lights::LampOptions read_luminaires(const std::vector<LuminaireFile>& files,
                                    std::map<std::string, std::size_t>& notes) {
  lights::LampOptions options;
  std::map<std::filesystem::path, lights::Luminaire> known;
  for (const LuminaireFile& choice : files) {
    auto found = known.find(choice.file);
    if (found == known.end())
      found = known.emplace(choice.file, lights::read_luminaire(choice.file)).first;
    const lights::Luminaire& luminaire = found->second;
    for (const std::string& note : luminaire.notes)
      ++notes[choice.file.filename().string() + ": " + note];
    options.luminaires.push_back({choice.file.string(), luminaire.photometry(), choice.highways,
                                  choice.types, choice.take_flux, luminaire.flux_lm,
                                  choice.models});
  }
  return options;
}

}  // namespace

CityLamps place_city_lamps(const City& city, const LampStageOptions& options) {
  std::map<std::string, std::size_t> notes;
  lights::LampOptions lamps = read_luminaires(options.luminaires, notes);
  lamps.heights_from_tags = !city.has_model();
  const osm::OsmData& map = city.map();
  const bool lay_out = options.lays_out() && !map.highways.empty();
  if (map.lamps.empty() && !lay_out) return {};
  city.require_lon_lat("lamps cannot be placed");
  const place::LonLatToFrame to_frame = city.to_frame();
  const place::HeightAt height_at = city.height_at();
  const place::InsideBuilding inside = city.inside_footprint();
  CityLamps result;
  if (options.layout.mode == layout::LayoutOptions::Mode::always)
    result.set.left_out["mapped, but [lamps] layout = \"always\""] = map.lamps.size();
  else
    result.set = lights::place_lamps(map, to_frame, height_at, inside, lamps);
  if (lay_out)
    result.layout =
        layout::lay_out_lamps(map, to_frame, height_at, inside, lamps, options.layout, result.set);
  place_on_bridges(city.bridges(), result.set);
  lights::switch_lamps(options.hours, result.set);
  if (const std::size_t gone = lights::merge_lamps(options.merge_m, result.set))
    notes["merged into a stronger lamp by [lamps] merge_m"] += gone;
  result.set.notes.merge(notes);
  return result;
}

}  // namespace nightcity::bake
