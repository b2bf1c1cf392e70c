// A pass that traces rays: a compute shader, by our own hierarchy or by ray queries, or a ray tracing
// pipeline. All come from one source (shaders/trace.glsl).
#pragma once

#include <variant>

#include "runtime/gpu/compute_pass.h"
#include "runtime/gpu/ray_tracing.h"
#include "shaders/interface.h"

namespace nightcity {

class TracePass {
 public:
  TracePass() = default;
  /// Of workgroups of group_width x group_height x 1.
  TracePass(gpu::ComputePass pass, std::uint32_t group_width, std::uint32_t group_height);
  explicit TracePass(gpu::RayPass pass);

  /// Records width x height x depth invocations; with compute, up to the next whole workgroup.
  void record(VkCommandBuffer commands, const gpu::Push& push, std::uint32_t width, std::uint32_t height = 1,
              std::uint32_t depth = 1) const;

 private:
  std::variant<gpu::ComputePass, gpu::RayPass> pass_;
  std::uint32_t group_width_ = 1, group_height_ = 1;
};

}  // namespace nightcity
