// A command buffer with a pool of its own.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>

namespace nightcity::gpu {

/// Makes `pool` for a queue family, and returns a command buffer of it, which may be reset and
/// recorded again. It is freed with the pool, which the caller destroys. Throws Error if Vulkan
/// fails.
VkCommandBuffer make_commands(VkDevice device, std::uint32_t queue_family, VkCommandPool& pool);

}  // namespace nightcity::gpu
