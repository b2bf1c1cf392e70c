// A colour image in the device's memory.
#pragma once

#include <vulkan/vulkan.h>

#include <glm/vec2.hpp>

#include "runtime/gpu/device.h"
#include "runtime/gpu/owned.h"

namespace nightcity::gpu {

/// Eight bits for each of R, G, B and A, R in the first byte. It is moved, not copied.
class Image {
 public:
  static constexpr VkFormat format = VK_FORMAT_R8G8B8A8_UNORM;

  Image() = default;
  /// `size`: pixels, at least one. The device must outlive the object.
  Image(const Device& device, glm::uvec2 size, VkImageUsageFlags usage);

  VkImage handle() const { return image_.get(); }
  glm::uvec2 size() const { return size_; }

 private:
  Owned<VkDeviceMemory, vkFreeMemory> memory_;  // outlives the image in it
  Owned<VkImage, vkDestroyImage> image_;
  glm::uvec2 size_{0};
};

}  // namespace nightcity::gpu
