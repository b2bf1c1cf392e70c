// The time and the memory that each stage of a bake takes.
#pragma once

#include <string>
#include <vector>

#include "tools/stopwatch.h"

namespace nightcity::bake {

struct StageCost {
  std::string name;
  double seconds = 0;
  double peak_mb = 0;  // of memory, from the program's start to the stage's end
};

class StageClock {
 public:
  /// Ends the stage that began with the last call, or with the clock.
  void end_stage(const char* name);
  const std::vector<StageCost>& stages() const { return stages_; }

 private:
  std::vector<StageCost> stages_;
  Stopwatch watch_;
};

}  // namespace nightcity::bake
