// Compiles the passes of a frame for given constants, and single passes that trace rays.
#pragma once

#include <cstdint>
#include <span>

#include "runtime/gpu/device.h"
#include "runtime/render/pass_set.h"

namespace nightcity::render {

constexpr gpu::Workgroup over_pixels{WORKGROUP_SIZE, WORKGROUP_SIZE};
constexpr gpu::Workgroup over_a_list{WORKGROUP_ROW, 1};

/// The SPIR-V of one pass for each tracing backend.
struct TraceShader {
  std::span<const std::uint32_t> compute, query, pipeline;
};

/// Returns the pass by the backend that the device traces with.
TracePass compile_trace(gpu::Device& device, const PassConstants& constants,
                        const TraceShader& shader, gpu::Workgroup workgroup);

/// Returns the passes of a frame, compiled on all cores. `draft` has passes in common with them,
/// which are taken from it; null: from none.
PassSet compile_passes(gpu::Device& device, const PassConstants& constants, Extent extent,
                       const PassSet* draft);

}  // namespace nightcity::render
