// When windows are lit: the night of one household, office floor, shop or staircase, as on and off
// times of each window.
#pragma once

#include "tools/lights/building_use.h"
#include "tools/lights/facades.h"
#include "tools/lights/night_schedule.h"
#include "tools/random.h"

namespace nightcity::lights {

/// The people behind a run of neighbouring windows, who decide about all of their rooms.
struct Household {
  BuildingUse use;
  bool present;    // tonight
  int from, to;    // awake or at work: minutes after 17:00
  int morning;     // when they get up
  bool all_night;  // night shift, security, an insomniac
  int cleaned;     // when the cleaners come to these rooms; -1: not tonight
};

/// Draws a household. `storey` is the random stream of the whole storey, shared by its households,
/// because cleaners go from room to room.
Household draw_household(BuildingUse use, Random& people, Random storey);

struct LitWindow {
  NightSchedule schedule;
  double luminance_cd_m2;  // mean over the opening, curtains and blinds included
  double cct_k;
};

/// Draws one window of a household. The windows of one staircase, lobby or shop belong to one
/// room: they are drawn from equal random streams and come out alike. Other windows have streams
/// of their own.
LitWindow draw_window(const Household& household, WindowKind kind, Random& random);

}  // namespace nightcity::lights
