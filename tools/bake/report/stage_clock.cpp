#include "tools/bake/report/stage_clock.h"

#include "tools/bake/report/peak_memory.h"

namespace nightcity::bake {

void StageClock::end_stage(const char* name) {
  stages_.push_back({name, watch_.lap_s(), find_peak_memory_mb()});
}

}  // namespace nightcity::bake
