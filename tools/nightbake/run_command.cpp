// nightbake run: a whole bake by recipe.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "formats/error.h"
#include "formats/program/output.h"
#include "tools/bake/bake.h"
#include "tools/bake/parts/bake_part.h"
#include "tools/nightbake/bake_results.h"
#include "tools/nightbake/commands.h"
#include "tools/nightbake/shown_progress.h"

namespace nightcity::nightbake {
namespace {

struct RunArguments {
  std::string recipe, part;
  BakeResults results;
};

void run_part(const RunArguments& arguments, const bake::Recipe& recipe) {
  const auto share = bake::parse_share(arguments.part);
  if (!share)
    throw UsageError("--part", "\"" + arguments.part +
                                   "\" is no part: write 3/64 for the third of 64 parts, at most "
                                   "of 100000");
  program::require_writable_folder(std::filesystem::path(arguments.results.folder) /
                                   bake::parts_folder);
  bake::BakedPart part;
  {
    ShownProgress progress;
    part = bake::bake_part(bake::make_bake_options(recipe), *share, arguments.results.folder,
                           NIGHTCITY_VERSION, progress.sink());
  }
  if (part.was_done)
    fmt::print("{}: is done already, from the same recipe and inputs\n", part.file.string());
  else
    fmt::print("{}: {} objects, {:.1f} MB\n", part.file.string(), part.objects,
               static_cast<double>(part.bytes) / 1e6);
}

void run(const RunArguments& arguments) {
  bake::Recipe recipe = bake::read_recipe(arguments.recipe);
  if (arguments.results.threads > 0) recipe.city.read.threads = arguments.results.threads;
  if (!arguments.part.empty()) return run_part(arguments, recipe);
  bake::BakeReport report;
  {
    ShownProgress progress;
    report = bake::bake(recipe, arguments.results.folder, progress.sink());
  }
  arguments.results.print(report);
}

}  // namespace

void add_run_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("run", "Bake a city by its recipe: DIR/city.glb and DIR/city.lights");
  auto arguments = std::make_shared<RunArguments>();
  command
      ->add_option("recipe", arguments->recipe, "Recipe (TOML): [city] files, [osm] files, options")
      ->required();
  arguments->results.declare(*command);
  command->add_option(
      "--part", arguments->part,
      "Make one part of the bake alone, such as 3/64 for the third of 64: "
      "DIR/parts/part-3-of-64. Parts may be made in any order and on many machines; "
      "nightbake merge puts them together. One that is done is kept");
  command->footer(
      "Examples:\n  nightbake run pipelines/berlin.toml --out berlin\n"
      "  nightbake run --json city.toml -o out | jq .citygml.skipped\n"
      "  nightbake run city.toml --part 3/64 -o out");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity::nightbake
