#include "runtime/gpu/compute_pass.h"

#include <algorithm>

#include "runtime/gpu/vulkan_check.h"

namespace nightcity::gpu {

ComputePass::ComputePass(const Device& device, std::span<const std::uint32_t> spirv,
                         std::span<const std::uint32_t> constants, std::uint32_t push_bytes,
                         Workgroup workgroup)
    : layout_(make_layout(device, VK_SHADER_STAGE_COMPUTE_BIT, push_bytes)),
      push_bytes_(push_bytes),
      workgroup_(workgroup) {
  const ShaderModule shader = make_shader(device, spirv);
  const Specialization specialization(constants);
  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.flags = VK_PIPELINE_CREATE_DISPATCH_BASE;  // dispatch_groups starts anywhere
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = shader.get();
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = specialization.info();
  info.layout = layout_.get();
  VkPipeline pipeline = VK_NULL_HANDLE;
  VK_CHECK(
      vkCreateComputePipelines(device.handle(), device.pipelines(), 1, &info, nullptr, &pipeline));
  pipeline_ = {pipeline, {device.handle()}};
}

void ComputePass::bind(VkCommandBuffer commands, const void* push) const {
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
  vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes_, push);
}

void ComputePass::dispatch(VkCommandBuffer commands, const void* push, std::uint32_t width,
                           std::uint32_t height, std::uint32_t depth) const {
  bind(commands, push);
  vkCmdDispatch(commands, (width + workgroup_.width - 1) / workgroup_.width,
                (height + workgroup_.height - 1) / workgroup_.height, depth);
}

std::uint32_t ComputePass::count_groups(std::uint32_t width, std::uint32_t height) const {
  return (width + workgroup_.width - 1) / workgroup_.width *
         ((height + workgroup_.height - 1) / workgroup_.height);
}

void ComputePass::dispatch_groups(VkCommandBuffer commands, const void* push, std::uint32_t width,
                                  std::uint32_t /*height*/, std::uint32_t first,
                                  std::uint32_t count, std::uint32_t depth) const {
  bind(commands, push);
  const std::uint32_t columns = (width + workgroup_.width - 1) / workgroup_.width;
  // The end of a row, whole rows together, the beginning of a row.
  while (count > 0) {
    const std::uint32_t x = first % columns, y = first / columns;
    const bool whole = x == 0 && count >= columns;
    const std::uint32_t across = whole ? columns : std::min(columns - x, count);
    const std::uint32_t down = whole ? count / columns : 1;
    vkCmdDispatchBase(commands, x, y, 0, across, down, depth);
    first += across * down;
    count -= across * down;
  }
}

}  // namespace nightcity::gpu
