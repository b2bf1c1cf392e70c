// Copies the renderer's picture to the window, and the window to memory.
#pragma once

#include <vulkan/vulkan.h>

#include <functional>
#include <glm/vec2.hpp>
#include <optional>

#include "runtime/gpu/buffer.h"
#include "runtime/gpu/device.h"
#include "runtime/measure/image.h"
#include "runtime/viewer/swapchain.h"

namespace nightcity::viewer {

class Screen {
 public:
  explicit Screen(gpu::Device& device);
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  /// Shows `picture` (size.x * size.y words, R in the low byte) over the swapchain's acquired
  /// image, stretched to the window, with `overlay` drawn on top. Stores what the window then shows
  /// in `grab`, unless that is null. Returns false when the swapchain needs resize().
  bool show(Swapchain& swapchain, const gpu::Buffer& picture, glm::uvec2 size,
            const std::function<void(VkCommandBuffer)>& overlay, measure::Image8* grab = nullptr);

 private:
  void hold(glm::uvec2 size);
  void release();

  gpu::Device& device_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkImage image_ = VK_NULL_HANDLE;  // the picture in a form that a blit can read
  VkDeviceMemory memory_ = VK_NULL_HANDLE;
  glm::uvec2 size_{0};
};

}  // namespace nightcity::viewer
