// Traces lists of rays on a device and times them alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/render/device_scene.h"
#include "runtime/render/pass_library.h"

namespace nightcity::render {

struct TracedRays {
  std::vector<float> distances;  // of the hits in units of `way`; 0 for any of them; -1 = none
  std::vector<double> ms;        // of each time that all rays were traced
};

/// Traces rays `repeats` times: for their closest hits on what is seen, or with `any_hit` for
/// whether they meet anything that casts a shadow. Vehicles move and are not met. There must be a
/// ray, and at most 4 million. The time is the device's own where it has a clock, otherwise the
/// host's. Throws Error.
TracedRays trace_rays(gpu::Device& device, PassLibrary& library, DeviceScene& scene,
                      std::span<const gpu::ProbeRay> rays, bool any_hit, std::uint32_t repeats);

}  // namespace nightcity::render
