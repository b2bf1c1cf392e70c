#include "runtime/gpu/compute_pass.h"

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
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = shader.get();
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = specialization.info();
  info.layout = layout_.get();
  VkPipeline pipeline = VK_NULL_HANDLE;
  VK_CHECK(vkCreateComputePipelines(device.handle(), device.pipelines(), 1, &info, nullptr, &pipeline));
  pipeline_ = {pipeline, {device.handle()}};
}

void ComputePass::dispatch(VkCommandBuffer commands, const void* push, std::uint32_t width,
                           std::uint32_t height, std::uint32_t depth) const {
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_.get());
  vkCmdPushConstants(commands, layout_.get(), VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes_, push);
  vkCmdDispatch(commands, (width + workgroup_.width - 1) / workgroup_.width,
                (height + workgroup_.height - 1) / workgroup_.height, depth);
}

}  // namespace nightcity::gpu
