// Render settings that tests start from.
#pragma once

#include <cstdint>

#include "runtime/render/settings.h"

namespace nightcity::test {

/// Returns the default settings with an estimator and without jitter, so that the layer "position"
/// is the very point that was shaded.
inline render::RenderSettings with_estimator(
    render::Estimator estimator, std::uint32_t candidates = render::SamplingSettings{}.candidates,
    float neighbour_radius_px = render::ReuseSettings{}.neighbour_radius_px,
    float max_history = render::ReuseSettings{}.max_history) {
  render::RenderSettings settings;
  settings.sampling.estimator = estimator;
  settings.sampling.jitter = false;
  settings.sampling.candidates = candidates;
  settings.reuse.neighbour_radius_px = neighbour_radius_px;
  settings.reuse.max_history = max_history;
  return settings;
}

}  // namespace nightcity::test
