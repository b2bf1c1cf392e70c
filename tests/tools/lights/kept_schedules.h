// A table of schedules whose times are kept in memory, for tests.
#pragma once

#include <vector>

#include "formats/night.h"
#include "formats/schedule.h"
#include "tools/lights/night_schedule.h"

namespace nightcity::test {

struct KeptSchedules {
  explicit KeptSchedules(std::size_t max_known = 100'000)
      : table(
            [this](std::span<const uint> times) {
              schedules.push_back(
                  {static_cast<uint>(switches.size()), static_cast<uint>(times.size())});
              switches.insert(switches.end(), times.begin(), times.end());
              return static_cast<std::uint32_t>(schedules.size() - 1);
            },
            max_known) {}
  KeptSchedules(const KeptSchedules&) = delete;

  std::vector<Schedule> schedules;
  std::vector<uint> switches;
  lights::ScheduleTable table;
};

}  // namespace nightcity::test
