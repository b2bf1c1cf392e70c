// A pedestrian's view along a street, found from the scene.
#pragma once

#include <optional>

#include "runtime/scene/camera.h"

namespace nightcity::scene {

/// Returns the view of a pedestrian who stands on the ground under the open sky, clear of walls,
/// and looks along a street: far ahead, with walls on both sides where there are houses, and where
/// there are lights along the way. Places are tried in front of lamps and all over the lit part.
/// The best of them is taken where a carriageway (carriageway.h) goes on ahead of it or of the
/// pavement beside it; otherwise the best on a street that the scene knows (street_places.h) or on
/// a carriageway; and the best of all where the scene has no streets. Nothing where no ground lies
/// under the open sky.
std::optional<CameraPose> find_street_view(const RenderScene& scene);

}  // namespace nightcity::scene
