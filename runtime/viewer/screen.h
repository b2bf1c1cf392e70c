// Copies the renderer's picture to the window, and the window to memory.
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <functional>
#include <glm/vec2.hpp>
#include <optional>
#include <span>

#include "runtime/gpu/buffer.h"
#include "runtime/gpu/device.h"
#include "runtime/gpu/image.h"
#include "runtime/measure/image.h"
#include "runtime/viewer/swapchain.h"

namespace nightcity::viewer {

/// A picture that is stretched to the window, whose left part is shown.
struct ShownPicture {
  const gpu::Buffer* words;  // size.x * size.y, R in the low byte
  glm::uvec2 size;
  float width = 1;  // of the part, as a share of the window's
};

class Screen {
 public:
  explicit Screen(gpu::Device& device);
  ~Screen();
  Screen(const Screen&) = delete;
  Screen& operator=(const Screen&) = delete;

  static constexpr std::size_t max_pictures = 2;

  /// Shows pictures, each over those before it, over the swapchain's acquired image, with `overlay`
  /// drawn on top. Stores what the window then shows in `grab`, unless that is null. Returns false
  /// when the swapchain needs resize().
  bool show(Swapchain& swapchain, std::span<const ShownPicture> pictures,
            const std::function<void(VkCommandBuffer)>& overlay, measure::Image8* grab = nullptr);

 private:
  void draw(const gpu::Image& held, const ShownPicture& picture, const Swapchain& swapchain);

  gpu::Device& device_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  std::array<gpu::Image, max_pictures> held_;  // pictures in a form that a blit can read
};

}  // namespace nightcity::viewer
