// The compiled passes, by specialization constants. Compiling takes a driver up to a second, so renderers of
// one device (another size, another scene) share them, and switching estimators back costs nothing.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <span>

#include "runtime/gpu/compute_pass.h"
#include "runtime/gpu/device.h"
#include "runtime/render/trace_pass.h"
#include "shaders/interface.h"

namespace nightcity {

using PassConstants = std::array<std::uint32_t, CONSTANT_COUNT>;

struct PassSet {
  gpu::ComputePass accumulate, demodulate, denoise;
  gpu::ComputePass vehicle_pose, vehicle_offsets, vehicle_order, vehicle_sort_cells,
      vehicle_bvh;  // only with traffic
  TracePass primary;
  TracePass reference;                             // only where the estimator is the reference
  TracePass candidates, temporal, spatial, shade;  // only where it is not
};

class PassLibrary {
 public:
  /// The device must outlive the library.
  explicit PassLibrary(gpu::Device& device) : device_(device) {}

  /// Compiled on first use; the reference stays good as long as the library.
  const PassSet& get(const PassConstants& constants);
  const TracePass& upward(const PassConstants& constants);

 private:
  // One pass, compiled for each way of tracing.
  struct TraceShader {
    std::span<const std::uint32_t> compute, query, pipeline;
  };
  TracePass make_trace(const PassConstants& constants, const TraceShader& shader,
                       gpu::Workgroup workgroup);

  gpu::Device& device_;
  std::map<PassConstants, PassSet> sets_;
  std::map<PassConstants, TracePass> upward_;
};

}  // namespace nightcity
