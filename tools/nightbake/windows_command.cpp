// nightbake windows: the windows of a city that have light at night, without baking it.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "formats/error.h"
#include "formats/light_file_writer.h"
#include "formats/program/number_check.h"
#include "formats/program/output.h"
#include "formats/program/print_json.h"
#include "tools/bake/bake_options.h"
#include "tools/bake/city/building_uses.h"
#include "tools/bake/city/object_versions.h"
#include "tools/bake/read_inputs.h"
#include "tools/bake/report/light_report.h"
#include "tools/bake/report/report_text.h"
#include "tools/bake/stages/light_stage.h"
#include "tools/nightbake/commands.h"
#include "tools/nightbake/shown_progress.h"

namespace nightcity::nightbake {
namespace {

struct WindowsArguments {
  std::vector<std::filesystem::path> inputs;
  std::string out;
  std::uint64_t seed = 1;
  bool seed_given = false, json = false;
};

bake::LightsReport write_windows(const WindowsArguments& arguments) {
  // The buildings of a map are the city where a recipe names no other.
  const bake::Recipe recipe = bake::read_inputs(arguments.inputs);
  bake::BakeOptions options =
      recipe.path.empty() ? bake::to_bake_options(recipe) : bake::make_bake_options(recipe);
  if (options.city.files.empty())
    throw UsageError(options.city.name(), "no city model among the inputs: windows are on walls");
  if (arguments.seed_given) options.windows.seed = arguments.seed;
  // First: an output that cannot be written is known before the long work.
  LightFileWriter lights(arguments.out);
  return bake::use_best_levels(options.city, [&] {
    bake::City city(options.city);
    bake::WindowConsumer windows(bake::make_use_finder(city), options.windows, arguments.out);
    ShownProgress progress;
    city.read({&windows}, progress.sink());
    city.build_ground({&windows});
    return bake::write_window_lights(lights, city, windows);
  });
}

void run(const WindowsArguments& arguments) {
  const bake::LightsReport report = write_windows(arguments);
  if (arguments.json) {
    nlohmann::json result = bake::to_json(report.windows);
    result["schedules"] = report.schedules;
    program::print_json(result);
  } else {
    fmt::print("{}{}", bake::to_text(report.windows),
               bake::report_line("schedules", std::to_string(report.schedules)));
  }
}

}  // namespace

void add_windows_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "windows", "Place windows on the walls of a city and print how many are lit at each hour");
  auto arguments = std::make_shared<WindowsArguments>();
  command
      ->add_option("input", arguments->inputs,
                   "City files and folders, OSM files for the use of buildings, or a recipe (TOML)")
      ->required();
  program::add_output_option(*command, arguments->out, "Light file to write (.lights)")->required();
  auto* seed = command
                   ->add_option("--seed", arguments->seed,
                                "Decides who is at home (default: the recipe's, else 1)")
                   ->check(program::count_from(0, std::numeric_limits<std::uint64_t>::max()));
  command->add_flag("--json", arguments->json, "Print the report as JSON");
  command->footer("Example: nightbake windows city.gml -o windows.lights");
  command->callback([arguments, seed] {
    arguments->seed_given = seed->count() > 0;
    run(*arguments);
  });
}

}  // namespace nightcity::nightbake
