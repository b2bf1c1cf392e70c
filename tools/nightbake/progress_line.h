// One line on the terminal that says how far the work has come; nothing where stderr is no terminal.
#pragma once

#include <chrono>
#include <string>

#include "tools/bake/progress.h"

namespace nightcity {

class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine() { clear(); }
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// For functions that report progress; refers to this object. Empty where nothing is to be shown.
  ProgressSink sink();

 private:
  void show(const Progress& progress);
  void clear();

  bool active_;
  bool shown_ = false;
  std::string stage_;
  std::chrono::steady_clock::time_point last_{};
};

}  // namespace nightcity
