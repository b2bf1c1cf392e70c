// A pedestrian's view along a street that is known by name.
#pragma once

#include <string>

#include "formats/scene_places.h"
#include "runtime/scene/camera.h"

namespace nightcity::scene {

struct NamedStreetView {
  CameraPose pose;
  bool from_above = false;  // there is no free place to stand on the street
};

/// Returns the view of a pedestrian who stands on the street and looks along it, where the street
/// is seen best: far, between houses, and where there are lights. On a square any direction will
/// do. Where nobody can stand (under a roof, beside the model) the view is one from above.
NamedStreetView find_view_of(const RenderScene& scene, const NamedStreet& street);

/// Returns the view of the street that `text` names best (find_streets). Throws Error, which says
/// what there is instead.
CameraPose find_view_of(const RenderScene& scene, const std::string& text);

}  // namespace nightcity::scene
