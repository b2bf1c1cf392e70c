#include "tools/nightbake/bake_results.h"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include "formats/program/number_check.h"
#include "formats/program/output.h"
#include "formats/program/print_json.h"

namespace nightcity::nightbake {

void BakeResults::declare(CLI::App& command) {
  program::add_output_option(command, folder, "Folder for the results; made where it is absent")
      ->required();
  command.add_flag("--json", json, "Print the report as JSON (it is in DIR/bake_report.json too)");
  command
      .add_option("--threads", threads,
                  "Number of threads, in place of the recipe's (default: one per core); the "
                  "results do not depend on it")
      ->check(program::count_from(1, 1024));
}

void BakeResults::print(const bake::BakeReport& report) const {
  if (json)
    program::print_json(bake::to_json(report));
  else
    fmt::print("{}", bake::to_text(report));
}

}  // namespace nightcity::nightbake
