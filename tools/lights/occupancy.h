// Who has light on, and when: the night of one household, office floor or shop, as on and off times of each
// window.
#pragma once

#include <array>
#include <cstdint>

#include "tools/lights/building_use.h"
#include "tools/lights/facades.h"
#include "tools/random.h"

namespace nightcity {

constexpr int night_minutes = 14 * 60;  // from 17:00 to 07:00

/// Up to four times of light, in minutes after 17:00, ascending and apart; on == off: not used. Times are in
/// steps of five minutes, so that many windows share one schedule.
struct NightSchedule {
  std::array<std::uint16_t, 4> on{}, off{};

  bool lit_at(int minute) const;
  bool never() const;
  auto operator<=>(const NightSchedule&) const = default;
};

/// Minutes after 17:00 of a clock time, e.g. (23, 30) or (3, 0).
constexpr int minute_of(int hour, int minute) {
  return ((hour + 24 - 17) % 24) * 60 + minute;
}

/// The people behind a run of neighbouring windows: what they do decides for all of their rooms.
struct Household {
  BuildingUse use;
  bool present;    // tonight
  int from, to;    // awake or at work: minutes after 17:00
  int morning;     // up again
  bool all_night;  // night shift, security, an insomniac
};

Household draw_household(BuildingUse use, Random& random);

struct LitWindow {
  NightSchedule schedule;
  double luminance_cd_m2;  // mean over the opening, curtains and blinds included
  double cct_k;
};

/// One window of a household.
LitWindow draw_window(const Household& household, WindowKind kind, Random& random);

}  // namespace nightcity
