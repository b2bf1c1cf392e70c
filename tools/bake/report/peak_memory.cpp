#include "tools/bake/report/peak_memory.h"

#include <fstream>
#include <string>

namespace nightcity::bake {

// Not getrusage(): its figure includes what the parent process had when it started this one.
double find_peak_memory_mb() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (double kilobytes = 0; word == "VmHWM:" && status >> kilobytes) return kilobytes / 1024;
  return 0;
}

}  // namespace nightcity::bake
