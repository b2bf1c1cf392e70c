// A night by its spans of light.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <utility>

#include "tools/lights/night_schedule.h"

namespace nightcity::lights {

inline NightSchedule night(std::initializer_list<std::pair<int, int>> times) {
  NightSchedule schedule;
  std::size_t n = 0;
  for (const auto& [on, off] : times) {
    schedule.on[n] = static_cast<std::uint16_t>(on);
    schedule.off[n++] = static_cast<std::uint16_t>(off);
  }
  return schedule;
}

}  // namespace nightcity::lights
