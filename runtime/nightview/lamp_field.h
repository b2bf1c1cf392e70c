// Synthetic streets without end: as many lamps and vehicles as one asks for, at the density of real streets.
#pragma once

#include <cstddef>

#include "runtime/scene/camera.h"
#include "runtime/scene/render_scene.h"

namespace nightcity {

/// Square blocks of 80 m with two houses each, and lamps every 27 m along their streets: 2,000 to 8,000 lm at
/// 6 m, each fiftieth a floodlight of 60,000 lm at 14 m; and `vehicles` with two headlamps of a narrow beam
/// and two tail lamps each, all on the road for the first 99 s of each hour. The same counts give the same
/// field.
RenderScene lamp_field(std::size_t lamps, std::size_t vehicles = 0);

/// From the roofs down a street in the middle of a field.
CameraPose lamp_field_camera();

}  // namespace nightcity
