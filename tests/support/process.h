// Runs a program of this build as a user would.
#pragma once

#include <stdlib.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "support/temp_folder.h"

namespace nightcity::test {

struct Outcome {
  int exit_code;  // -1: ended by a signal
  std::string out, err;
};

/// Returns the path as a shell word, with a space on either side.
inline std::string quoted(const std::filesystem::path& path) {
  return " '" + path.string() + "' ";
}

/// Runs `program` of this build with `arguments` (shell words), and returns how it ended and what
/// it printed.
inline Outcome run_program(const std::string& program, const std::string& arguments) {
  const TempFolder folder;
  const std::string command = std::string("'") + NIGHTCITY_BUILD_DIR + "/" + program + "' " +
                              arguments + " >'" + (folder / "out").string() + "' 2>'" +
                              (folder / "err").string() + "' </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(folder / "out"),
          read_text(folder / "err")};
}

}  // namespace nightcity::test
