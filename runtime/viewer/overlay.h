// Dear ImGui over the picture: its context, its Vulkan objects, its share of mouse and keyboard.
#pragma once

#include <vulkan/vulkan.h>

#include "runtime/gpu/device.h"
#include "runtime/viewer/swapchain.h"
#include "runtime/viewer/window.h"

namespace nightcity {

class Overlay {
 public:
  Overlay(gpu::Device& device, const Window& window, const Swapchain& swapchain);
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  /// Between begin() and end(), ImGui's functions draw.
  void begin();
  void end();
  /// Records what was drawn, within the swapchain's overlay pass.
  void record(VkCommandBuffer commands);

  bool wants_mouse() const;
  bool wants_keys() const;

 private:
  gpu::Device& device_;
  VkDescriptorPool descriptors_ = VK_NULL_HANDLE;
};

}  // namespace nightcity
