// The parts that compute and ray tracing pipelines share.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/gpu/owned.h"

namespace nightcity::gpu {

using Pipeline = Owned<VkPipeline, vkDestroyPipeline>;
using PipelineLayout = Owned<VkPipelineLayout, vkDestroyPipelineLayout>;
using ShaderModule = Owned<VkShaderModule, vkDestroyShaderModule>;

/// Returns a layout with push constants for one stage, and nothing to bind.
PipelineLayout make_layout(const Device& device, VkShaderStageFlags stage,
                           std::uint32_t push_bytes);

ShaderModule make_shader(const Device& device, std::span<const std::uint32_t> spirv);

/// Specialization constant i takes values[i]. It refers to `values`, which must outlive it.
class Specialization {
 public:
  explicit Specialization(std::span<const std::uint32_t> values);
  Specialization(const Specialization&) = delete;
  Specialization& operator=(const Specialization&) = delete;
  const VkSpecializationInfo* info() const { return &info_; }

 private:
  std::vector<VkSpecializationMapEntry> entries_;
  VkSpecializationInfo info_{};
};

}  // namespace nightcity::gpu
