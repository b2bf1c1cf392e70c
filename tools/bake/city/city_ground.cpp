#include "tools/bake/city/city_ground.h"

#include <cmath>
#include <memory>

#include "formats/error.h"
#include "tools/inputs/city_files.h"
#include "tools/bake/city/city_reader.h"
#include "tools/bake/city/ground_builder.h"
#include "tools/inputs/file_format.h"
#include "tools/lights/osm_uses.h"

namespace nightcity {

void read_ground(const Recipe& recipe, const CityFrames& frames, Terrain& terrain,
                 std::optional<WindowLayout>& windows, const ProgressSink& progress,
                 streets::RoadSurfaces* roads) {
  const auto nowhere = std::filesystem::temp_directory_path() / "nightbake";
  SceneWriter writer(nowhere, {});
  TileStore tiles(nowhere, recipe.city.tile_m, std::round(frames.reference().z));
  DrapeStore drape(nowhere);
  BakeReport unused;
  read_city(recipe, frames, {writer, tiles, drape, terrain, windows, roads}, unused, progress);
  lay_ground(recipe, frames, terrain, tiles);
}

WindowOptions window_options(const Recipe& recipe, const OsmData& osm, const CityFrames& frames) {
  WindowOptions options;
  options.seed = recipe.windows.seed;
  if (osm.buildings.empty() || !frames.city().has_lon_lat()) return options;
  const auto uses = std::make_shared<const OsmUses>(osm.buildings, [&](const glm::dvec2& lon_lat) {
    return frames.city().from_lon_lat(lon_lat);
  });
  options.use_at = [uses](const glm::dvec2& place) { return uses->at(place); };
  return options;
}

Recipe recipe_of(const std::vector<std::filesystem::path>& inputs) {
  if (inputs.size() == 1 && inputs.front().extension() == ".toml")
    return read_recipe(inputs.front());
  Recipe recipe;
  for (const auto& input : inputs) {
    std::error_code error;
    if (input.extension() == ".toml")
      throw UsageError(input.string(), "a recipe stands alone: other files belong into it");
    if (std::filesystem::is_directory(input, error)) {
      const auto found = inputs::city_files(input);
      recipe.city.files.insert(recipe.city.files.end(), found.begin(), found.end());
      continue;
    }
    switch (inputs::find_format(input).kind) {
      case inputs::FileKind::city:
        recipe.city.files.push_back(input);
        break;
      case inputs::FileKind::osm:
        recipe.osm.files.push_back(input);
        break;
      default:
        throw Error(input.string(), "is neither a city model nor OSM");
    }
  }
  return recipe;
}

Georeference georeference_of(const Recipe& recipe, const CityFrames& frames) {
  Georeference result;
  result.crs = frames.city().crs();
  const glm::dvec3& middle = frames.reference();
  result.origin = {recipe.origin.easting.value_or(std::round(middle.x)),
                   recipe.origin.northing.value_or(std::round(middle.y)),
                   recipe.origin.height.value_or(std::round(middle.z))};
  for (const auto& file : recipe.city.files) result.sources.push_back(file.filename().string());
  for (const auto& file : recipe.osm.files) result.sources.push_back(file.filename().string());
  result.licences = recipe.city.licences;
  if (!recipe.osm.files.empty()) result.licences.push_back(recipe.osm.licence);
  return result;
}

}  // namespace nightcity
