// A pedestrian's view along a street, found from the geometry.
#pragma once

#include <optional>

#include "runtime/scene/camera.h"

namespace nightcity::scene {

/// Returns the view of a pedestrian who stands on the ground under the open sky, clear of walls,
/// and looks along a street: far ahead, with walls on both sides where there are houses, and where
/// there are lights along the way. Places are tried in front of lamps and all over the lit part.
/// Nothing where no ground lies under the open sky.
std::optional<CameraPose> find_street_view(const RenderScene& scene);

}  // namespace nightcity::scene
