// The time that a step of the work takes.
#pragma once

#include <chrono>

namespace nightcity {

class Stopwatch {
 public:
  /// Returns the seconds since the last call, or since the stopwatch was made.
  double lap_s() {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - start_).count();
    start_ = now;
    return seconds;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace nightcity
