#include "runtime/gpu/pipeline.h"

#include "runtime/gpu/vulkan_check.h"

namespace nightcity::gpu {

PipelineLayout make_layout(const Device& device, VkShaderStageFlags stage,
                           std::uint32_t push_bytes) {
  const VkPushConstantRange range{stage, 0, push_bytes};
  VkPipelineLayoutCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
  info.pushConstantRangeCount = 1;
  info.pPushConstantRanges = &range;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VK_CHECK(vkCreatePipelineLayout(device.handle(), &info, nullptr, &layout));
  return {layout, {device.handle()}};
}

ShaderModule make_shader(const Device& device, std::span<const std::uint32_t> spirv) {
  VkShaderModuleCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
  info.codeSize = spirv.size_bytes();
  info.pCode = spirv.data();
  VkShaderModule shader = VK_NULL_HANDLE;
  VK_CHECK(vkCreateShaderModule(device.handle(), &info, nullptr, &shader));
  return {shader, {device.handle()}};
}

Specialization::Specialization(std::span<const std::uint32_t> values) {
  for (std::uint32_t i = 0; i < values.size(); ++i) entries_.push_back({i, i * 4, 4});
  info_.mapEntryCount = static_cast<std::uint32_t>(entries_.size());
  info_.pMapEntries = entries_.data();
  info_.dataSize = values.size_bytes();
  info_.pData = values.data();
}

}  // namespace nightcity::gpu
