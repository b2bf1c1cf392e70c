// The rungs of a governor, measured on a device and a scene at one go.
#pragma once

#include <functional>
#include <vector>

#include "runtime/render/rung_meter.h"

namespace nightcity::experiments {

/// Measures the rungs between one candidate and `settings` as render::RungMeter does. Every place
/// has render::rung_frames moments. `make_renderer` makes a renderer of the picture's size.
/// `progress` is called with the rungs measured so far and their number.
std::vector<render::Rung> measure_rungs(
    const std::function<render::Renderer()>& make_renderer,
    const std::vector<std::vector<render::Moment>>& places, const render::RenderSettings& settings,
    bool errors, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace nightcity::experiments
