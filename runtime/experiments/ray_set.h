// Rays as frames have them, for measuring how fast they are traced.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/scene/camera.h"
#include "runtime/scene/render_scene.h"
#include "shaders/frame.h"

namespace nightcity::experiments {

/// Returns the camera's rays through the middles of a picture's pixels, in squares of 8 x 8, as
/// passes trace them.
std::vector<gpu::ProbeRay> make_primary_rays(const scene::CameraPose& pose, std::uint32_t width,
                                             std::uint32_t height);

/// Returns shadow rays from where the camera's rays end, in their order: each towards one light,
/// chosen from 24 by flux in proportion to the inverse square of its distance. There is none where
/// the camera sees no surface, or where all of these lights are behind it.
std::vector<gpu::ProbeRay> make_shadow_rays(const scene::RenderScene& scene,
                                            std::span<const gpu::ProbeRay> primary);

}  // namespace nightcity::experiments
