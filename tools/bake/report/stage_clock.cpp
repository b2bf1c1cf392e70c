#include "tools/bake/report/stage_clock.h"

#include "tools/bake/report/peak_memory.h"

namespace nightcity {

void StageClock::end_stage(const char* name) {
  const auto now = std::chrono::steady_clock::now();
  stages_.push_back(
      {name, std::chrono::duration<double>(now - start_).count(), find_peak_memory_mb()});
  start_ = now;
}

}  // namespace nightcity
