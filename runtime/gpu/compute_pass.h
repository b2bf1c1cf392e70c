// A compute shader with specialization constants and push constants, and nothing else to bind.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>

#include "runtime/gpu/device.h"
#include "runtime/gpu/pipeline.h"

namespace nightcity::gpu {

/// A compute shader's local size, as the shader declares it; its depth is 1.
struct Workgroup {
  std::uint32_t width = 1, height = 1;
};

class ComputePass {
 public:
  ComputePass() = default;
  /// Specialization constant i takes constants[i]; `push_bytes` is the size of the push constants.
  ComputePass(const Device& device, std::span<const std::uint32_t> spirv,
              std::span<const std::uint32_t> constants, std::uint32_t push_bytes,
              Workgroup workgroup = {});

  /// Records width x height x depth invocations, rounded up to whole workgroups.
  void dispatch(VkCommandBuffer commands, const void* push, std::uint32_t width,
                std::uint32_t height = 1, std::uint32_t depth = 1) const;

  /// Returns the number of workgroups over width x height invocations.
  std::uint32_t count_groups(std::uint32_t width, std::uint32_t height) const;
  /// Records what dispatch() does for `count` of these workgroups, row by row, from `first` on.
  void dispatch_groups(VkCommandBuffer commands, const void* push, std::uint32_t width,
                       std::uint32_t height, std::uint32_t first, std::uint32_t count,
                       std::uint32_t depth = 1) const;

 private:
  void bind(VkCommandBuffer commands, const void* push) const;

  PipelineLayout layout_;
  Pipeline pipeline_;
  std::uint32_t push_bytes_ = 0;
  Workgroup workgroup_;
};

}  // namespace nightcity::gpu
