// Compares sources of light candidates by error and time, over numbers of lights.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/measure/table.h"
#include "runtime/render/settings.h"

namespace nightcity::experiments {

struct StrategiesOptions {
  gpu::Device::Options device;
  std::filesystem::path folder;  // gets strategies.csv and the reference pictures
  std::uint32_t width = 320, height = 180;
  std::vector<std::size_t> lights;  // numbers of lamps
  std::uint32_t candidates = render::SamplingSettings{}.candidates, reference_frames = 8;
  std::uint32_t frames = 16;  // whose mean is measured, beside a single frame
};

/// Renders synthetic streets with each number of lamps and each mixture of sources, by `ris` and by
/// the default estimator. Returns error and cost, a row per combination. Throws Error.
measure::Table compare_strategies(const StrategiesOptions& options);

}  // namespace nightcity::experiments
