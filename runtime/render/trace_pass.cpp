#include "runtime/render/trace_pass.h"

#include <utility>

namespace nightcity {

TracePass::TracePass(gpu::ComputePass pass, std::uint32_t group_width, std::uint32_t group_height)
    : pass_(std::move(pass)), group_width_(group_width), group_height_(group_height) {}

TracePass::TracePass(gpu::RayPass pass) : pass_(std::move(pass)) {}

void TracePass::record(VkCommandBuffer commands, const gpu::Push& push, std::uint32_t width,
                       std::uint32_t height, std::uint32_t depth) const {
  if (const auto* rays = std::get_if<gpu::RayPass>(&pass_))
    rays->trace(commands, &push, width, height, depth);
  else
    std::get<gpu::ComputePass>(pass_).dispatch(commands, &push, (width + group_width_ - 1) / group_width_,
                                               (height + group_height_ - 1) / group_height_, depth);
}

}  // namespace nightcity
