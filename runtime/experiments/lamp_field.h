// Synthetic streets with any number of lamps and vehicles, as dense as real streets.
#pragma once

#include <cstddef>

#include "runtime/scene/camera.h"
#include "runtime/scene/render_scene.h"

namespace nightcity::experiments {

/// Returns square blocks of 80 m with two houses each and a lamp every 27 m along their streets:
/// 2,000 to
/// 8,000 lm at 6 m, every fiftieth a floodlight of 60,000 lm at 14 m. `vehicles` with two narrow
/// headlamps and two tail lamps each move during the first 99 s of each hour. Equal counts give
/// equal fields.
scene::RenderScene make_lamp_field(std::size_t lamps, std::size_t vehicles = 0);

/// Returns a camera above the roofs that looks down a street in the middle of a field.
scene::CameraPose lamp_field_camera();

}  // namespace nightcity::experiments
