// The times between the pictures that a window shows while its view moves.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace nightcity::viewer {

/// Collects them. Times are seconds of any clock that does not go back.
class FrameIntervals {
 public:
  /// Only the last ones are kept: ten minutes at 60 pictures a second.
  static constexpr std::size_t most = 36'000;

  /// Says that a picture was shown. An interval lies between two of them that follow each other
  /// `in_motion`: while the view moved or its clock ran.
  void add(double now_s, bool in_motion);
  /// Returns how many intervals there were.
  std::size_t count() const { return count_; }
  /// Returns "240 intervals, 8.1 ms in the median, 99 % within 9.0 ms, all within 12.3 ms", "" without
  /// one.
  std::string describe() const;

 private:
  std::optional<double> last_s_;  // of a picture in motion, if the last one was
  std::vector<double> kept_s_;    // the oldest at count_ % most once there are so many
  std::size_t count_ = 0;
};

}  // namespace nightcity::viewer
