// The compiled passes, by specialization constants. Compiling takes a driver up to a second, so renderers of
// one device (another size, another scene) share them, and switching estimators back costs nothing.
#pragma once

#include <array>
#include <cstdint>
#include <map>

#include "runtime/gpu/compute_pass.h"
#include "runtime/gpu/device.h"
#include "shaders/interface.h"

namespace nightcity {

using PassConstants = std::array<std::uint32_t, CONSTANT_COUNT>;

struct PassSet {
  gpu::ComputePass primary, accumulate, demodulate, denoise;
  gpu::ComputePass fleet_pose, fleet_offsets, fleet_order, fleet_settle, fleet_tree;  // only with traffic
  gpu::ComputePass reference;                             // only where the estimator is the reference
  gpu::ComputePass candidates, temporal, spatial, shade;  // only where it is not
};

class PassLibrary {
 public:
  /// The device must outlive the library.
  explicit PassLibrary(gpu::Device& device) : device_(device) {}

  /// Compiled on first use; the reference stays good as long as the library.
  const PassSet& get(const PassConstants& constants);
  const gpu::ComputePass& upward(const PassConstants& constants);

 private:
  gpu::Device& device_;
  std::map<PassConstants, PassSet> sets_;
  std::map<PassConstants, gpu::ComputePass> upward_;
};

}  // namespace nightcity
