// Bodies that would stand in one another: looked for in the traffic as it will be shown.
#pragma once

#include <vector>

#include "formats/light_file.h"

namespace nightcity::traffic {

struct OverlapReport {
  std::size_t vehicle_samples = 0;  // vehicles looked at, over all moments
  std::size_t overlapping = 0;      // of them, in another body
  std::vector<bool> drop;  // by trip: without these nobody overlaps (at the moments looked at)
  std::size_t dropped = 0;
};

/// Looks at one whole cycle with every trip on the road, every `step_s`. Bodies are the kinds' boxes,
/// `slack_m` smaller on every side: mirrors touch no walls. Of two that overlap the one with fewer others to
/// blame is kept.
OverlapReport find_overlaps(const TrafficContent& traffic, double step_s, double slack_m);

}  // namespace nightcity::traffic
