// The results of a bake, as the commands that make one write and print them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "tools/bake/bake.h"

namespace nightcity::nightbake {

struct BakeResults {
  std::string folder;
  bool json = false;     // the report is printed as JSON
  unsigned threads = 0;  // 0 = the recipe's

  /// Declares --out, --json and --threads.
  void declare(CLI::App& command);
  /// Prints the report to stdout.
  void print(const bake::BakeReport& report) const;
};

}  // namespace nightcity::nightbake
