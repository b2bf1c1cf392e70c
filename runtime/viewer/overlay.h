// Dear ImGui over the picture: its context, its Vulkan objects, and whether it uses mouse and
// keyboard.
#pragma once

#include <vulkan/vulkan.h>

#include "runtime/gpu/device.h"
#include "runtime/viewer/swapchain.h"
#include "runtime/viewer/window.h"

namespace nightcity::viewer {

class Overlay {
 public:
  Overlay(gpu::Device& device, const Window& window, const Swapchain& swapchain);
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  /// ImGui's functions may draw between begin() and end().
  void begin();
  void end();
  /// Records the drawing, inside the swapchain's overlay pass.
  void record(VkCommandBuffer commands);

  bool wants_mouse() const;
  bool wants_keys() const;

 private:
  gpu::Device& device_;
  VkDescriptorPool descriptors_ = VK_NULL_HANDLE;
};

}  // namespace nightcity::viewer
