// GPU times of passes, by timestamp queries.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/gpu/device.h"

namespace nightcity::gpu {

class Timer {
 public:
  explicit Timer(Device& device);
  ~Timer();
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

  /// Starts a command buffer's timing: call it first, then mark(name) after each pass.
  void start(VkCommandBuffer commands);
  void mark(VkCommandBuffer commands, const char* name);
  /// Returns, after the commands have run, the milliseconds from one mark to the next. Empty on
  /// queues without timestamps.
  struct Span {
    std::string name;
    double ms;
  };
  std::vector<Span> collect();

 private:
  static constexpr std::uint32_t capacity = 256;
  Device& device_;
  VkQueryPool pool_ = VK_NULL_HANDLE;
  std::vector<const char*> names_;
};

/// Returns the milliseconds of all spans together.
double sum_ms(std::span<const Timer::Span> spans);

}  // namespace nightcity::gpu
