// The rungs of a governor, measured on a device and a scene.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runtime/render/governor.h"
#include "runtime/scene/camera.h"

namespace nightcity::experiments {

/// The view and the time that a frame shows.
struct Moment {
  scene::CameraPose pose;
  double time_s;  // of the clock, since noon
};

/// The frames that measure_rungs renders in each place.
constexpr std::uint32_t rung_frames = 11;

/// Returns the moments of `rung_frames` frames at rest.
std::vector<Moment> at_rest(const scene::CameraPose& pose, double time_s);

/// Returns the rungs, in rising order of time, between one candidate and `settings`, with the
/// milliseconds of a frame in these places (the slowest frame but one, of the slowest place) and,
/// where `errors` asks for it, the noise of a frame (the greatest). A place is `rung_frames`
/// moments, one after the other: a camera that moves brings into view what has no history, and its
/// frames take longer than those of a camera at rest. `make_renderer` makes a renderer of the
/// picture's size. `progress` is called with the rungs measured so far and their number.
std::vector<render::Rung> measure_rungs(
    const std::function<render::Renderer()>& make_renderer,
    const std::vector<std::vector<Moment>>& places, const render::RenderSettings& settings,
    bool errors, const std::function<void(std::size_t, std::size_t)>& progress);

/// Returns the decision in words: frame, rungs, reason.
std::string describe(const render::Governor& governor, const render::Governor::Decision& decision);

/// Returns what the governor starts with, in words; with its rungs' times and errors.
std::string describe_start(const render::Governor& governor,
                           const render::GovernorOptions& options);

}  // namespace nightcity::experiments
