// Who has light on, and when: the night of one household, office floor, shop or staircase, as on and off
// times of each window.
#pragma once

#include "tools/lights/building_use.h"
#include "tools/lights/facades.h"
#include "tools/lights/night_schedule.h"
#include "tools/random.h"

namespace nightcity {

/// The people behind a run of neighbouring windows: what they do decides for all of their rooms.
struct Household {
  BuildingUse use;
  bool present;    // tonight
  int from, to;    // awake or at work: minutes after 17:00
  int morning;     // up again
  bool all_night;  // night shift, security, an insomniac
  int cleaned;     // when the cleaners come to these rooms; -1: not tonight
};

/// `storey`: the stream of the whole storey, shared by all of its households (cleaners go from room to room).
Household draw_household(BuildingUse use, Random& people, Random storey);

struct LitWindow {
  NightSchedule schedule;
  double luminance_cd_m2;  // mean over the opening, curtains and blinds included
  double cct_k;
};

/// One window of a household. Windows of one staircase, lobby or shop are one room behind several panes: they
/// are drawn from equal streams and come out alike; other windows have each their own.
LitWindow draw_window(const Household& household, WindowKind kind, Random& random);

}  // namespace nightcity
