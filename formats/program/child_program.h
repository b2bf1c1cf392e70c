// Other programs that ours start: nightview by nightbake, ffmpeg by nightview.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace nightcity::program {

struct ChildResult {
  int status;          // as waitpid's
  std::string output;  // what it wrote to standard output, where that was asked for
};

/// Runs a program to its end; nothing where there is none of that name. `words` are its name,
/// which is searched for in PATH where it holds no slash, and its arguments. Its messages go to
/// stderr, and its output with `keep_output` to the result, through memory, so that no file is left
/// behind. The program ends with this one, however that ends. Throws Error where it cannot be run.
std::optional<ChildResult> run_child(const std::vector<std::string>& words, bool keep_output);

}  // namespace nightcity::program
