#include "formats/schedule.h"

#include <algorithm>
#include <cmath>

namespace nightcity {

bool is_lit(const Schedule& schedule, std::span<const std::uint32_t> switches, double time_s) {
  constexpr double day_s = 86'400;
  const double t = time_s - day_s * std::floor(time_s / day_s);
  const auto times = switches.subspan(schedule.first, schedule.count);
  const auto switched =
      std::upper_bound(times.begin(), times.end(), t,
                       [](double at, std::uint32_t time) { return at < double(time); });
  return (switched - times.begin()) % 2 == 1;
}

}  // namespace nightcity
