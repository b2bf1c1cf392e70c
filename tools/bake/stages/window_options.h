// Options of the stage that makes lit windows.
#pragma once

#include <cstdint>

#include "tools/lights/facades.h"
#include "tools/lights/window_groups.h"

namespace nightcity::bake {

struct WindowStageOptions {
  bool lit = true;         // false: there are none
  std::uint64_t seed = 1;  // decides who is at home
  lights::WindowGrouping group = lights::WindowGrouping::none;
  bool panes = true;  // of single windows; false, or of groups: even rectangles
  int max_per_building = static_cast<int>(lights::default_max_windows);
};

}  // namespace nightcity::bake
