// nightbake traffic: the drives of a night, without baking the city.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "formats/error.h"
#include "tools/bake/city_stage.h"
#include "tools/bake/ground_stage.h"
#include "tools/bake/traffic_stage.h"
#include "tools/bake/traffic_tables.h"
#include "tools/nightbake/commands.h"
#include "tools/nightbake/progress_line.h"

namespace nightcity {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string recipe, out, lights;
  bool json = false;
};

/// The ground and the buildings as a bake has them; the scene it would write goes nowhere.
void read_ground(const Recipe& recipe, const CityFrames& frames, Terrain& terrain,
                 const ProgressSink& progress) {
  const fs::path nowhere = fs::temp_directory_path() / "nightbake-traffic";
  SceneWriter writer(nowhere, {});
  TileStore tiles(nowhere, recipe.city.tile_m, std::round(frames.reference().z));
  DrapeStore drape(nowhere);
  std::optional<WindowLayout> no_windows;
  BakeReport unused;
  read_city(recipe, frames, {writer, tiles, drape, terrain, no_windows}, unused, progress);
  lay_ground(recipe, frames, terrain, tiles);
}

/// Where traffic alone stands: origin at the recipe's, else in the city.
Georeference own_georeference(const Recipe& recipe, const CityFrames& frames) {
  const glm::dvec3 middle = glm::round(frames.reference());
  Georeference result;
  result.crs = frames.city().crs();
  result.origin = {recipe.origin.easting.value_or(middle.x), recipe.origin.northing.value_or(middle.y),
                   recipe.origin.height.value_or(middle.z)};
  for (const auto& file : recipe.osm.files) result.sources.push_back(file.filename().string());
  result.licences = recipe.city.licences;
  result.licences.push_back(recipe.osm.licence);
  return result;
}

void run(const Arguments& arguments) {
  Recipe recipe = read_recipe(arguments.recipe);
  if (recipe.osm.files.empty())
    throw UsageError(arguments.recipe, "names no [osm] files: streets come from the map");
  const CityFrames frames(recipe);
  OsmData osm;
  for (const auto& file : recipe.osm.files) osm.merge(read_osm(file));
  std::optional<LightFile> lights;
  LightFileContent content;
  if (arguments.lights.empty()) {
    content.georeference = own_georeference(recipe, frames);
  } else {
    lights = LightFile::open(arguments.lights);
    content = content_of(*lights);
    if (content.georeference.crs != frames.city().crs())
      throw Error(arguments.lights,
                  "is in " + content.georeference.crs + ", the recipe's city in " + frames.city().crs());
  }
  traffic::TrafficSet traffic;
  {
    ProgressLine progress;
    Terrain terrain;
    read_ground(recipe, frames, terrain, progress.sink());
    traffic = make_city_traffic(recipe, osm, frames, terrain, content.georeference, progress.sink());
  }
  write_with_traffic(arguments.out, content, traffic);
  if (arguments.json)
    fmt::print("{}\n", to_json(traffic.report).dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  else
    fmt::print("{}", to_text(traffic.report));
}

}  // namespace

void add_traffic_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "traffic", "Drive vehicles through a recipe's streets and write their drives to a light file");
  auto arguments = std::make_shared<Arguments>();
  command
      ->add_option("recipe", arguments->recipe,
                   "Recipe (TOML): [city] files for the ground, [osm] files for the streets, [traffic]")
      ->required();
  command->add_option("-o,--out", arguments->out, "Light file to write")->required();
  command->add_option("--lights", arguments->lights,
                      "Light file whose lights go into it too; the traffic it has is replaced");
  command->add_flag("--json", arguments->json, "Print the report as JSON");
  command->footer(
      "[traffic] may say vehicles = N (at 22:00) or per_km = X (of lane), cycle_s, side = \"left\" or "
      "\"right\",\n"
      "hours = [24 shares from noon on] and seed. `nightbake run` bakes the same traffic, with bodies.\n"
      "Examples: nightbake traffic town.toml --out traffic.lights\n"
      "          nightbake traffic town.toml --lights city.lights --out city.lights");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity
