// Other programs that ours start: nightview by nightbake and by its window, ffmpeg by nightview.
#pragma once

#include <sys/types.h>

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

/// A program that runs beside this one and ends with the object, or with this program, however that
/// ends. What it writes to standard output and to stderr is kept in memory.
class ChildProgram {
 public:
  /// Starts it; `words` are as run_child takes them. Throws Error where it cannot be run.
  explicit ChildProgram(const std::vector<std::string>& words);
  ~ChildProgram();
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  /// Asks it to end, and does not wait until it has.
  void stop();
  /// Returns how it ended, as waitpid's; nothing while it runs. Does not wait.
  std::optional<int> find_status();
  /// Return what it has written so far: to standard output, and to stderr.
  std::string read_output() const;
  std::string read_messages() const;

 private:
  int output_ = -1, messages_ = -1;
  pid_t child_ = -1;
  std::optional<int> status_;
};

}  // namespace nightcity::program
