// The panel's widgets for the night: the clock, the lights, sky and weather.
#pragma once

#include "runtime/viewer/panel.h"

namespace nightcity::viewer {

void draw_night(ViewerState& state);

}  // namespace nightcity::viewer
