// Dear ImGui over the picture: its context and its Vulkan objects.
#pragma once

#include <vulkan/vulkan.h>

#include <filesystem>

#include "runtime/gpu/device.h"
#include "runtime/viewer/swapchain.h"
#include "runtime/viewer/window.h"

namespace nightcity::viewer {

class Overlay {
 public:
  /// `font_px`: height of the text in pixels.
  Overlay(gpu::Device& device, const Window& window, const Swapchain& swapchain, float font_px);
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  /// Puts panels where they were when save_places() wrote `file`; a file that is missing or broken
  /// changes nothing.
  void load_places(const std::filesystem::path& file);
  /// Throws Error when the file cannot be written.
  void save_places(const std::filesystem::path& file) const;

  /// Hands the panel the next events of `queue`. ImGui's functions may draw between begin() and
  /// end().
  void begin(InputQueue& queue);
  void end();
  /// Records the drawing, inside the swapchain's overlay pass.
  void record(VkCommandBuffer commands);

 private:
  gpu::Device& device_;
  VkDescriptorPool descriptors_ = VK_NULL_HANDLE;
};

}  // namespace nightcity::viewer
