// Commands that run on the device while the program goes on.
#pragma once

#include <vulkan/vulkan.h>

#include "runtime/gpu/device.h"

namespace nightcity::gpu {

/// One command buffer at a time: begin(), submit(), then wait() until it has run. Device::run may
/// be called meanwhile; the queue runs both in their order.
class Submission {
 public:
  /// The device must outlive the object. Throws Error if Vulkan fails.
  explicit Submission(Device& device);
  /// Waits for commands that still run.
  ~Submission();
  Submission(const Submission&) = delete;
  Submission& operator=(const Submission&) = delete;

  /// Starts recording, after waiting for the commands before.
  VkCommandBuffer begin();
  void submit();
  bool is_running() const { return running_; }
  /// Waits at most `seconds` (0 only asks), and returns whether nothing runs any more.
  bool wait(double seconds);

 private:
  Device& device_;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  bool running_ = false;
};

}  // namespace nightcity::gpu
