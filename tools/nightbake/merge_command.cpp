// nightbake merge: the parts of a bake, put together.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "formats/program/output.h"
#include "formats/program/print_json.h"
#include "tools/bake/bake.h"
#include "tools/nightbake/commands.h"
#include "tools/nightbake/shown_progress.h"

namespace nightcity::nightbake {
namespace {

struct MergeArguments {
  std::vector<std::string> parts;
  std::string recipe, folder;
  bool json = false;
  unsigned threads = 0;
};

void run(const MergeArguments& arguments) {
  bake::BakeReport report;
  {
    ShownProgress progress;
    report =
        bake::merge_parts({arguments.parts.begin(), arguments.parts.end()}, arguments.recipe,
                          arguments.folder, NIGHTCITY_VERSION, progress.sink(), arguments.threads);
  }
  if (arguments.json)
    program::print_json(bake::to_json(report));
  else
    fmt::print("{}", bake::to_text(report));
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
  program::add_output_option(*command, arguments->folder,
                             "Folder for the results; made where it is absent")
      ->required();
  command->add_option("--recipe", arguments->recipe,
                      "Recipe of the bake (default: the one that the parts name, by its path)");
  command->add_flag("--json", arguments->json,
                    "Print the report as JSON (it is in DIR/bake_report.json too)");
  command
      ->add_option("--threads", arguments->threads,
                   "Number of threads, in place of the recipe's (default: one per core); the "
                   "results do not depend on it")
      ->check(CLI::Range(1, 1024));
  command->footer("Example: nightbake merge out/parts --out out");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace nightcity::nightbake
