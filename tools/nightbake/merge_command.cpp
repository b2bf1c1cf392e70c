// nightbake merge: the parts of a bake, put together.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "tools/bake/bake.h"
#include "tools/nightbake/bake_results.h"
#include "tools/nightbake/commands.h"
#include "tools/nightbake/shown_progress.h"

namespace nightcity::nightbake {
namespace {

struct MergeArguments {
  std::vector<std::string> parts;
  std::string recipe;
  BakeResults results;
};

void run(const MergeArguments& arguments) {
  bake::BakeReport report;
  {
    ShownProgress progress;
    report = bake::merge_parts({arguments.parts.begin(), arguments.parts.end()}, arguments.recipe,
                               arguments.results.folder, NIGHTCITY_VERSION, progress.sink(),
                               arguments.results.threads);
  }
  arguments.results.print(report);
}

}  // namespace

void add_merge_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "merge", "Put the parts of a bake together: the same bytes as nightbake run without --part");
  auto arguments = std::make_shared<MergeArguments>();
  command
      ->add_option("parts", arguments->parts,
                   "Parts made by nightbake run --part, or folders that hold them, in any order")
      ->required();
  arguments->results.declare(*command);
  command->add_option("--recipe", arguments->recipe,
                      "Recipe of the bake (default: the one that the parts name, by its path)");
  command->footer("Example: nightbake merge out/parts --out out");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity::nightbake
