// A pass that traces rays: a compute shader with our own BVHs or ray queries, or a ray tracing
// pipeline. All of them are compiled from one source (shaders/trace.glsl).
#pragma once

#include <utility>
#include <variant>

#include "runtime/gpu/compute_pass.h"
#include "runtime/gpu/ray_tracing.h"

namespace nightcity::render {

class TracePass {
 public:
  TracePass() = default;
  explicit TracePass(gpu::ComputePass pass) : pass_(std::move(pass)) {}
  explicit TracePass(gpu::RayPass pass) : pass_(std::move(pass)) {}

  /// Records width x height x depth invocations.
  void dispatch(VkCommandBuffer commands, const void* push, std::uint32_t width,
                std::uint32_t height = 1, std::uint32_t depth = 1) const {
    std::visit([&](const auto& pass) { pass.dispatch(commands, push, width, height, depth); },
               pass_);
  }

  /// Returns the number of parts into which dispatch_groups() can cut width x height invocations:
  /// workgroups, or 1 for a ray tracing pipeline.
  std::uint32_t count_groups(std::uint32_t width, std::uint32_t height) const {
    const auto* compute = std::get_if<gpu::ComputePass>(&pass_);
    return compute ? compute->count_groups(width, height) : 1;
  }
  /// Records `count` of these parts from `first` on.
  void dispatch_groups(VkCommandBuffer commands, const void* push, std::uint32_t width,
                       std::uint32_t height, std::uint32_t first, std::uint32_t count,
                       std::uint32_t depth = 1) const {
    if (const auto* compute = std::get_if<gpu::ComputePass>(&pass_))
      compute->dispatch_groups(commands, push, width, height, first, count, depth);
    else
      dispatch(commands, push, width, height, depth);
  }

 private:
  std::variant<gpu::ComputePass, gpu::RayPass> pass_;
};

}  // namespace nightcity::render
