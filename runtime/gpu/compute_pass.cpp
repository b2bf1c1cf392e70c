#include "runtime/gpu/compute_pass.h"

#include <utility>
#include <vector>

#include "runtime/gpu/vulkan_check.h"

namespace nightcity::gpu {

ComputePass::ComputePass(Device& device, std::span<const std::uint32_t> spirv,
                         std::span<const std::uint32_t> constants, std::uint32_t push_bytes)
    : device_(&device), push_bytes_(push_bytes) {
  const VkPushConstantRange range{VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes};
  VkPipelineLayoutCreateInfo layout{};
  layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  layout.pushConstantRangeCount = 1;
  layout.pPushConstantRanges = &range;
  VK_CHECK(vkCreatePipelineLayout(device.handle(), &layout, nullptr, &layout_));

  VkShaderModuleCreateInfo module_info{};
  module_info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  module_info.codeSize = spirv.size_bytes();
  module_info.pCode = spirv.data();
  VkShaderModule module = VK_NULL_HANDLE;
  VK_CHECK(vkCreateShaderModule(device.handle(), &module_info, nullptr, &module));

  std::vector<VkSpecializationMapEntry> entries;
  for (std::uint32_t i = 0; i < constants.size(); ++i) entries.push_back({i, i * 4, 4});
  VkSpecializationInfo specialization{};
  specialization.mapEntryCount = static_cast<std::uint32_t>(entries.size());
  specialization.pMapEntries = entries.data();
  specialization.dataSize = constants.size_bytes();
  specialization.pData = constants.data();

  VkComputePipelineCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
  info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
  info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
  info.stage.module = module;
  info.stage.pName = "main";
  info.stage.pSpecializationInfo = &specialization;
  info.layout = layout_;
  const VkResult result =
      vkCreateComputePipelines(device.handle(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_);
  vkDestroyShaderModule(device.handle(), module, nullptr);
  check(result, "vkCreateComputePipelines");
}

ComputePass::~ComputePass() {
  if (!device_) return;
  vkDestroyPipeline(device_->handle(), pipeline_, nullptr);
  vkDestroyPipelineLayout(device_->handle(), layout_, nullptr);
}

ComputePass::ComputePass(ComputePass&& other) noexcept {
  *this = std::move(other);
}

ComputePass& ComputePass::operator=(ComputePass&& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(layout_, other.layout_);
  std::swap(pipeline_, other.pipeline_);
  std::swap(push_bytes_, other.push_bytes_);
  return *this;
}

void ComputePass::dispatch(VkCommandBuffer commands, const void* push, std::uint32_t groups_x,
                           std::uint32_t groups_y, std::uint32_t groups_z) const {
  vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, pipeline_);
  vkCmdPushConstants(commands, layout_, VK_SHADER_STAGE_COMPUTE_BIT, 0, push_bytes_, push);
  vkCmdDispatch(commands, groups_x, groups_y, groups_z);
}

}  // namespace nightcity::gpu
