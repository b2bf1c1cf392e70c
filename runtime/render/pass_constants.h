// Chooses the constants with which the passes of a frame are compiled: they lack what neither the
// scene nor the settings need.
#pragma once

#include <vector>

#include "runtime/render/device_scene.h"
#include "runtime/render/pass_library.h"
#include "runtime/render/settings.h"

namespace nightcity::render {

/// Returns whether passes have air compiled in, which they may without need: see forced_features.
bool has_air(const RenderSettings& settings);

/// `traits`: of the scene that is rendered, or those that are expected while it is read.
PassConstants find_constants(const RenderSettings& settings, const scene::SceneTraits& traits);

/// Returns the features that neither the scene nor the settings need: passes are compiled without
/// them.
std::vector<Feature> list_unneeded(const RenderSettings& settings, const DeviceScene& scene);

}  // namespace nightcity::render
