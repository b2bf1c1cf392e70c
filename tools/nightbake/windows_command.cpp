// nightbake windows: the windows of a city that have light at night, without baking it.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "formats/error.h"
#include "formats/light_file_writer.h"
#include "tools/bake/city/city_ground.h"
#include "tools/bake/scene/light_places.h"
#include "tools/bake/stages/lamp_stage.h"
#include "tools/bake/stages/light_stage.h"
#include "tools/nightbake/commands.h"
#include "tools/nightbake/progress_line.h"

namespace nightcity {
namespace {

struct WindowsArguments {
  std::vector<std::filesystem::path> inputs;
  std::string out;
  std::uint64_t seed = 1;
  bool seed_given = false, json = false;
};

WindowReport lay(const WindowsArguments& arguments, std::size_t& schedule_count) {
  const Recipe recipe = recipe_of(arguments.inputs);
  if (recipe.city.files.empty())
    throw UsageError("", "no CityGML among the inputs: windows sit on walls");
  LightFileWriter lights(arguments.out);
  const CityFrames frames(recipe);
  const Georeference georeference = georeference_of(recipe, frames);
  Terrain terrain;
  std::optional<WindowLayout> windows;
  OsmData osm;
  for (const auto& file : recipe.osm.files) osm.merge(read_osm(file));
  WindowOptions options = window_options(recipe, osm, frames);
  if (arguments.seed_given) options.seed = arguments.seed;
  windows.emplace(options, arguments.out);
  ProgressLine progress;
  read_ground(recipe, frames, terrain, windows, progress.sink());
  ScheduleTable schedules = schedules_of(lights);
  const auto place = [&](const LitRectangle& window) {
    lights.add(to_light(window, georeference, schedules), window.provenance);
  };
  const auto inside = [&](const glm::dvec3& p) { return inside_building(terrain, p); };
  const WindowReport report =
      std::move(*windows).finish(height_on(terrain), place, inside, recipe.city.read.threads);
  lights.finish({.georeference = georeference});
  schedule_count = schedules.size();
  return report;
}

void run(const WindowsArguments& arguments) {
  std::size_t schedules = 0;
  const WindowReport report = lay(arguments, schedules);
  if (arguments.json) {
    nlohmann::json result = to_json(report);
    result["schedules"] = schedules;
    fmt::print("{}\n", result.dump(2, ' ', false, nlohmann::json::error_handler_t::replace));
  } else {
    fmt::print("{}{}", to_text(report), report_line("schedules", std::to_string(schedules)));
  }
}

}  // namespace

void add_windows_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("windows", "Lay windows on a city's walls and tell who has light on when");
  auto arguments = std::make_shared<WindowsArguments>();
  command
      ->add_option(
          "input", arguments->inputs,
          "CityGML files and folders, OSM files for the use of buildings, or a recipe (TOML)")
      ->required();
  command->add_option("-o,--out", arguments->out, "Light file to write (.lights)")->required();
  auto* seed = command->add_option("--seed", arguments->seed,
                                   "Who is at home (default: the recipe's, or 1)");
  command->add_flag("--json", arguments->json, "Print the report as JSON");
  command->footer("Example: nightbake windows city.gml -o windows.lights");
  command->callback([arguments, seed] {
    arguments->seed_given = seed->count() > 0;
    run(*arguments);
  });
}

}  // namespace nightcity
