// Measures how much of a city's light leaves it upwards: for each light, and on a map.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/render/device_scene.h"
#include "runtime/render/pass_library.h"

namespace nightcity::render {

struct UpwardSettings {
  double time_s = 8 * 3600;             // since noon
  std::uint32_t rays = 1024;            // per light, 1 .. 2^20
  std::uint32_t bounces = MAX_BOUNCES;  // off surfaces, 0 .. MAX_BOUNCES
  std::uint32_t seed = 0;
  float cell_m = 4;  // side of the map's cells; enlarged where there would be over 2^24 of them
};

struct UpwardFlux {
  struct Shares {
    double direct, reflected, sideways;  // of the light's flux, as in gpu::Escape
  };
  std::vector<Shares> lights;   // the static lights, then VEHICLE_LIGHTS per trip
  std::vector<double> flux_lm;  // of the same lights at this moment, 0 where one is off

  // The map: lumens that leave from each square, row by row towards the south.
  float origin_x = 0, origin_z = 0, cell_m = 0;
  std::uint32_t width = 0, depth = 0;
  std::vector<double> cells_lm;
};

/// Traces stratified rays from every light by its own distribution, and on from the surfaces
/// they hit. The shares are Monte Carlo estimates: their relative standard error is about 1 /
/// sqrt(rays) for a narrow beam and smaller for a wide one. Throws Error.
UpwardFlux measure_upward_flux(gpu::Device& device, PassLibrary& passes, DeviceScene& scene,
                               const UpwardSettings& settings);

}  // namespace nightcity::render
