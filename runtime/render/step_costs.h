// Learns how long the parts of a frame's steps take, to cut the next ones to a time.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace nightcity::render {

class StepCosts {
 public:
  /// Says that `count` parts of a step ran for `seconds`.
  void learn(const std::string& step, std::uint32_t count, double seconds);
  /// Returns the seconds that the dearest part of late took, 0 where that is not known.
  double of_part(const std::string& step) const;
  /// Returns how many of a step's `parts` are to run next, at least one, so that they take
  /// `seconds`, and hardly ever half as much again.
  std::uint32_t parts_within(const std::string& step, std::uint32_t parts, double seconds) const;
  /// Returns the seconds that so many parts are expected to take: most are not the dearest.
  double expect(const std::string& step, std::uint32_t count) const;

 private:
  struct Cost {
    double part_s = 0;        // 0 = not known
    double run_s = 0;         // of the run that said so
    std::uint32_t count = 0;  // parts in that run
    std::uint32_t last = 0;   // parts in the last run
  };
  std::map<std::string, Cost> costs_;
};

}  // namespace nightcity::render
