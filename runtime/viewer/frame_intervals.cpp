#include "runtime/viewer/frame_intervals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace nightcity::viewer {

void FrameIntervals::add(double now_s, bool in_motion) {
  if (in_motion && last_s_) {
    const double interval_s = now_s - *last_s_;
    if (kept_s_.size() < most)
      kept_s_.push_back(interval_s);
    else
      kept_s_[count_ % most] = interval_s;
    ++count_;
  }
  last_s_.reset();
  if (in_motion) last_s_ = now_s;
}

std::string FrameIntervals::describe() const {
  if (count_ == 0) return "";
  std::vector<double> sorted = kept_s_;
  std::sort(sorted.begin(), sorted.end());
  const auto within_ms = [&sorted](double share) {
    const auto place = static_cast<std::size_t>(std::ceil(share * double(sorted.size())));
    return 1000 * sorted[std::max<std::size_t>(place, 1) - 1];
  };
  return fmt::format(
      "{} interval{}, {:.1f} ms in the median, 99 % within {:.1f} ms, all within {:.1f} ms", count_,
      count_ == 1 ? "" : "s", within_ms(0.5), within_ms(0.99), within_ms(1));
}

}  // namespace nightcity::viewer
