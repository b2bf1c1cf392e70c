// The images a window shows, and the steps of showing one.
#pragma once

#include <vulkan/vulkan.h>

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "runtime/gpu/device.h"
#include "runtime/gpu/image.h"

namespace nightcity::viewer {

/// Shows one frame at a time, because the renderer waits for its device anyway.
class Swapchain {
 public:
  /// Takes ownership of the surface. Without one (null) there are images that are drawn into as any
  /// other, and seen by nobody. Throws Error when the device cannot show pictures in this window.
  Swapchain(gpu::Device& device, VkSurfaceKHR surface);
  ~Swapchain();
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  /// Recreates the images for a window of this size in pixels.
  void resize(glm::uvec2 size);

  /// Waits for an image to draw into. Returns false when the window has changed and needs resize().
  bool acquire();
  /// Shows the image after `commands`, which must leave it in VK_IMAGE_LAYOUT_PRESENT_SRC_KHR.
  /// Returns false as acquire() does.
  bool present(VkCommandBuffer commands);

  VkImage image() const { return images_[current_]; }
  VkFramebuffer framebuffer() const { return framebuffers_[current_]; }
  /// Returns a render pass that draws over the image (in VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL)
  /// and leaves it ready to be shown.
  VkRenderPass overlay_pass() const { return overlay_pass_; }
  VkFormat format() const { return format_.format; }
  glm::uvec2 size() const { return size_; }
  std::uint32_t images() const { return static_cast<std::uint32_t>(images_.size()); }

 private:
  void create_overlay_pass();
  void create_swapchain(glm::uvec2 size);
  void create_framebuffers();
  void release_images();
  void release();

  gpu::Device& device_;
  VkSurfaceKHR surface_;
  VkSurfaceFormatKHR format_{};
  VkRenderPass overlay_pass_ = VK_NULL_HANDLE;
  VkSwapchainKHR swapchain_ = VK_NULL_HANDLE;
  glm::uvec2 size_{0};
  std::array<gpu::Image, 2> unseen_;  // in place of a swapchain's images, which are two or more
  std::vector<VkImage> images_;
  std::vector<VkImageView> views_;
  std::vector<VkFramebuffer> framebuffers_;
  // One per image, because the window system uses it until the image comes back.
  std::vector<VkSemaphore> drawn_;
  VkFence acquired_ = VK_NULL_HANDLE;
  VkFence finished_ = VK_NULL_HANDLE;
  std::uint32_t current_ = 0;
};

}  // namespace nightcity::viewer
