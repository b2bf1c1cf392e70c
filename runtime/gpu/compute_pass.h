// One compute shader: SPIR-V, specialization constants, push constants, and nothing else to bind.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>

#include "runtime/gpu/device.h"

namespace nightcity::gpu {

class ComputePass {
 public:
  ComputePass() = default;
  /// Specialization constant i takes constants[i].
  ComputePass(Device& device, std::span<const std::uint32_t> spirv, std::span<const std::uint32_t> constants,
              std::uint32_t push_bytes);
  ~ComputePass();
  ComputePass(ComputePass&& other) noexcept;
  ComputePass& operator=(ComputePass&& other) noexcept;

  void dispatch(VkCommandBuffer commands, const void* push, std::uint32_t groups_x,
                std::uint32_t groups_y = 1, std::uint32_t groups_z = 1) const;

 private:
  Device* device_ = nullptr;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  std::uint32_t push_bytes_ = 0;
};

}  // namespace nightcity::gpu
