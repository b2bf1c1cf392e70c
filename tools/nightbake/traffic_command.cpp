// nightbake traffic: the drives of a night, without baking the city.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "formats/error.h"
#include "tools/bake/city_ground.h"
#include "tools/bake/traffic_stage.h"
#include "tools/bake/traffic_tables.h"
#include "tools/nightbake/commands.h"
#include "tools/nightbake/progress_line.h"

namespace nightcity {
namespace {

struct Arguments {
  std::string recipe, out, lights;
  bool json = false;
};

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
    content.georeference = georeference_of(recipe, frames);
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
    std::optional<WindowLayout> no_windows;
    read_ground(recipe, frames, terrain, no_windows, progress.sink());
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
