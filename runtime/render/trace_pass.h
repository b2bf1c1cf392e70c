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

 private:
  std::variant<gpu::ComputePass, gpu::RayPass> pass_;
};

}  // namespace nightcity::render
