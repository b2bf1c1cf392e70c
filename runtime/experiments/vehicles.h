// The cost of a frame against the number of vehicles that move in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/measure/table.h"
#include "runtime/render/settings.h"

namespace nightcity::experiments {

struct VehiclesOptions {
  gpu::Device::Options device;
  std::uint32_t width = 1280, height = 720;
  render::Estimator estimator = render::SamplingSettings{}.estimator;
  std::vector<std::size_t> vehicles;  // numbers of vehicles
  std::size_t lamps = 10'000;         // the size of the field
  std::uint32_t frames = 32;          // timed
  double time_step_s = 1.0 / 60;      // the clock moves on by this much before every frame
};

/// Times frames on synthetic streets where all vehicles move. Returns medians by the device's
/// clock, a row per number of vehicles: all passes, each pass that moves vehicles, and the others.
/// Throws Error.
measure::Table time_vehicles(const VehiclesOptions& options);

}  // namespace nightcity::experiments
