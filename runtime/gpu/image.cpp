#include "runtime/gpu/image.h"

#include "runtime/gpu/vulkan_check.h"

namespace nightcity::gpu {

Image::Image(const Device& device, glm::uvec2 size, VkImageUsageFlags usage) : size_(size) {
  VkImageCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = format;
  info.extent = {size.x, size.y, 1};
  info.mipLevels = 1;
  info.arrayLayers = 1;
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.usage = usage;
  VkImage image = VK_NULL_HANDLE;
  VK_CHECK(vkCreateImage(device.handle(), &info, nullptr, &image));
  image_ = {image, {device.handle()}};
  VkMemoryRequirements needs{};
  vkGetImageMemoryRequirements(device.handle(), image, &needs);
  VkMemoryAllocateInfo allocate{};
  allocate.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
  allocate.allocationSize = needs.size;
  allocate.memoryTypeIndex =
      device.memory_type(needs.memoryTypeBits, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VK_CHECK(vkAllocateMemory(device.handle(), &allocate, nullptr, &memory));
  memory_ = {memory, {device.handle()}};
  VK_CHECK(vkBindImageMemory(device.handle(), image, memory, 0));
}

}  // namespace nightcity::gpu
