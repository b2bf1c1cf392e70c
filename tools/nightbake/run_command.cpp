// nightbake run: a whole bake by recipe.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "formats/program/output.h"
#include "formats/program/print_json.h"
#include "tools/bake/bake.h"
#include "tools/nightbake/commands.h"
#include "tools/nightbake/shown_progress.h"

namespace nightcity::nightbake {
namespace {

struct RunArguments {
  std::string recipe, folder;
  bool json = false;
  unsigned threads = 0;
};

void run(const RunArguments& arguments) {
  bake::Recipe recipe = bake::read_recipe(arguments.recipe);
  if (arguments.threads > 0) recipe.city.read.threads = arguments.threads;
  bake::BakeReport report;
  {
    ShownProgress progress;
    report = bake::bake(recipe, arguments.folder, progress.sink());
  }
  if (arguments.json)
    program::print_json(bake::to_json(report));
  else
    fmt::print("{}", bake::to_text(report));
}

}  // namespace

void add_run_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("run", "Bake a city by its recipe: DIR/city.glb and DIR/city.lights");
  auto arguments = std::make_shared<RunArguments>();
  command
      ->add_option("recipe", arguments->recipe, "Recipe (TOML): [city] files, [osm] files, options")
      ->required();
  program::add_output_option(*command, arguments->folder,
                             "Folder for the results; made where it is absent")
      ->required();
  command->add_flag("--json", arguments->json,
                    "Print the report as JSON (it is in DIR/bake_report.json too)");
  command
      ->add_option("--threads", arguments->threads,
                   "Number of threads, in place of the recipe's (default: one per core); the "
                   "results do not depend on it")
      ->check(CLI::Range(1, 1024));
  command->footer(
      "Examples:\n  nightbake run pipelines/berlin.toml --out berlin\n"
      "  nightbake run --json city.toml -o out | jq .citygml.skipped");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity::nightbake
