// The rungs of a governor, measured on a device and a scene.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runtime/render/governor.h"
#include "runtime/scene/camera.h"

namespace nightcity::experiments {

/// Returns the rungs, in rising order of time, between one candidate and `settings`, with the
/// milliseconds of a frame in these views (the greatest median) and, where `errors` asks for it,
/// the noise of a frame (the greatest). `make_renderer` makes a renderer of the picture's size.
/// `progress` is called with the rungs measured so far and their number.
std::vector<render::Rung> measure_rungs(
    const std::function<render::Renderer()>& make_renderer,
    const std::vector<scene::CameraPose>& poses, const render::RenderSettings& settings,
    bool errors, const std::function<void(std::size_t, std::size_t)>& progress);

/// Returns the decision in words: frame, rungs, reason.
std::string describe(const render::Governor& governor, const render::Governor::Decision& decision);

/// Returns what the governor starts with, in words; with its rungs' times and errors.
std::string describe_start(const render::Governor& governor,
                           const render::GovernorOptions& options);

}  // namespace nightcity::experiments
