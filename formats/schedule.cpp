#include "formats/schedule.h"

#include <algorithm>
#include <cmath>

namespace nightcity {
namespace {

// Returns the noon before a time, in seconds since the same noon.
double find_noon(double time_s) {
  return day_s * std::floor(time_s / day_s);
}

// Returns how many of the times, ascending, are not after `t`.
std::size_t count_until(std::span<const std::uint32_t> times, double t) {
  const auto after =
      std::upper_bound(times.begin(), times.end(), t,
                       [](double at, std::uint32_t time) { return at < double(time); });
  return static_cast<std::size_t>(after - times.begin());
}

}  // namespace

bool is_lit(const Schedule& schedule, std::span<const std::uint32_t> switches, double time_s) {
  return count_until(switches.subspan(schedule.first, schedule.count), time_s - find_noon(time_s)) %
             2 ==
         1;
}

TimeSpan find_steady_span(std::span<const Schedule> schedules,
                          std::span<const std::uint32_t> switches, double time_s) {
  const double noon_s = find_noon(time_s);
  double first_s = 0, end_s = day_s;
  for (const Schedule& schedule : schedules) {
    const auto times = switches.subspan(schedule.first, schedule.count);
    const std::size_t switched = count_until(times, time_s - noon_s);
    if (switched > 0) first_s = std::max(first_s, double(times[switched - 1]));
    if (switched < times.size()) end_s = std::min(end_s, double(times[switched]));
  }
  return {noon_s + first_s, noon_s + end_s};
}

}  // namespace nightcity
