// When a light of a schedule is lit: the one meaning of the schedule records of night.h. Shared by
// what writes them, by what counts them and by the renderer.
#pragma once

#include <cstdint>
#include <span>

#include "formats/night.h"

namespace nightcity {

inline constexpr uint day_s = 86'400;

/// Returns whether a light with this schedule is lit `time_s` seconds after noon. Times outside a
/// day wrap round. `switches` holds the switch times of the whole light file.
bool is_lit(const Schedule& schedule, std::span<const std::uint32_t> switches, double time_s);

/// A part of the time, in seconds since a noon: from `first_s` until before `end_s`.
struct TimeSpan {
  double first_s = 0, end_s = 0;
  bool has(double time_s) const { return time_s >= first_s && time_s < end_s; }
};

/// Returns the part round `time_s` during which none of the schedules switches a light. It ends at
/// noon.
TimeSpan find_steady_span(std::span<const Schedule> schedules,
                          std::span<const std::uint32_t> switches, double time_s);

}  // namespace nightcity
