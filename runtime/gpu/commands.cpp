#include "runtime/gpu/commands.h"

#include "runtime/gpu/vulkan_check.h"

namespace nightcity::gpu {

VkCommandBuffer make_commands(VkDevice device, std::uint32_t queue_family, VkCommandPool& pool) {
  VkCommandPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
  info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
  info.queueFamilyIndex = queue_family;
  VK_CHECK(vkCreateCommandPool(device, &info, nullptr, &pool));
  VkCommandBufferAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
  allocate.commandPool = pool;
  allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
  allocate.commandBufferCount = 1;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VK_CHECK(vkAllocateCommandBuffers(device, &allocate, &commands));
  return commands;
}

}  // namespace nightcity::gpu
