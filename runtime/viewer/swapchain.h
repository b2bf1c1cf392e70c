// The images a window shows, and the steps of showing one.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "runtime/gpu/device.h"

namespace nightcity {

/// One frame at a time: the renderer waits for its device anyway.
class Swapchain {
 public:
  /// Takes the surface. Throws Error when the device cannot show pictures in this window.
  Swapchain(gpu::Device& device, VkSurfaceKHR surface);
  ~Swapchain();
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  /// Makes the images anew for a window of this size.
  void resize(glm::uvec2 size);

  /// Waits for an image to draw into. False: the window has changed and wants resize().
  bool acquire();
  /// Shows the image after `commands`, which leave it in VK_IMAGE_LAYOUT_PRESENT_SRC_KHR. False as for
  /// acquire().
  bool present(VkCommandBuffer commands);

  VkImage image() const { return images_[current_]; }
  VkFramebuffer framebuffer() const { return framebuffers_[current_]; }
  /// Draws over what the image holds (VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL), leaves it ready to be shown.
  VkRenderPass overlay_pass() const { return overlay_pass_; }
  VkFormat format() const { return format_.format; }
  glm::uvec2 size() const { return size_; }
  std::uint32_t images() const { return static_cast<std::uint32_t>(images_.size()); }

 private:
  void create_overlay_pass();
  void release_images();
  void release();

  gpu::Device& device_;
  VkSurfaceKHR surface_;
  VkSurfaceFormatKHR format_{};
  VkRenderPass overlay_pass_ = VK_NULL_HANDLE;
  VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
  glm::uvec2 size_{0};
  std::vector<VkImage> images_;
  std::vector<VkImageView> views_;
  std::vector<VkFramebuffer> framebuffers_;
  std::vector<VkSemaphore>
      drawn_;  // one an image: the window system holds it until the image comes back
  VkFence acquired_ = VK_NULL_HANDLE;
  VkFence finished_ = VK_NULL_HANDLE;
  std::uint32_t current_ = 0;
};

}  // namespace nightcity
