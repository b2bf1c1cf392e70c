// How much of a city's light leaves it upwards, light by light and place by place.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/render/device_scene.h"
#include "runtime/render/pass_library.h"

namespace nightcity {

struct UpwardSettings {
  double time_s = 8 * 3600;   // since noon
  std::uint32_t rays = 1024;  // a light, 1 .. 2^20
  std::uint32_t seed = 0;
  float cell_m = 4;  // of the map; more where that would make over 2^24 cells
};

struct UpwardFlux {
  struct Shares {
    double direct, reflected, sideways;  // of the light's flux, as in gpu::Escape
  };
  std::vector<Shares> lights;   // the scene's standing lights, then VEHICLE_LIGHTS a trip
  std::vector<double> flux_lm;  // parallel: what each gives at this moment, 0 where it is off

  // The map: lumen that leave from each square, row by row to the south.
  float origin_x = 0, origin_z = 0, cell_m = 0;
  std::uint32_t width = 0, depth = 0;
  std::vector<double> cells_lm;
};

/// Traces every light's own distribution, stratified, straight and off the first surface. Monte Carlo: a
/// light's shares have a standard error of about 1 / sqrt(rays) of what they are for a narrow beam, less for
/// a wide one. Throws Error.
UpwardFlux upward_flux(gpu::Device& device, PassLibrary& passes, DeviceScene& scene,
                       const UpwardSettings& settings);

}  // namespace nightcity
