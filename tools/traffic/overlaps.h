// Finds vehicles whose bodies would overlap in the traffic as it will be shown.
#pragma once

#include <vector>

#include "formats/light_file.h"

namespace nightcity::traffic {

struct OverlapReport {
  std::size_t vehicle_samples = 0;  // vehicles checked, summed over all moments
  std::size_t overlapping = 0;      // those of them that overlap another body
  std::vector<bool>
      leave_out;  // by trip: without these trips no bodies overlap at the moments checked
  std::size_t left_out = 0;
};

/// Checks one whole cycle, with every trip on the road, in steps of `step_s` seconds. A body is the
/// box of its kind of vehicle, smaller by `slack_m` metres on every side, because mirrors do not
/// count. Of two bodies that overlap, the one that overlaps fewer others is kept.
OverlapReport find_overlaps(const TrafficContent& traffic, double step_s, double slack_m);

}  // namespace nightcity::traffic
