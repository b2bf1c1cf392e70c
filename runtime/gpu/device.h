// A Vulkan device with one compute-and-graphics queue, chosen by name or index.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/gpu/device_info.h"

namespace nightcity::gpu {

class Device {
 public:
  struct Options {
    std::string
        select;  // "" = the best usable device; else an index, or part of a name in any case
    bool validation = false;
    Trace trace = Trace::compute;                  // refused if the device lacks it
    std::vector<const char*> instance_extensions;  // required by a window system
    std::vector<const char*> device_extensions;
  };

  /// Throws UsageError if no device matches or it cannot trace that way, Error if Vulkan fails.
  explicit Device(const Options& options);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  const DeviceInfo& info() const { return info_; }
  VkInstance instance() const { return instance_; }
  VkPhysicalDevice physical() const { return physical_; }
  VkDevice handle() const { return device_; }
  VkQueue queue() const { return queue_; }
  std::uint32_t queue_family() const { return queue_family_; }
  Trace trace() const { return trace_; }
  /// Returns the device's name, plus the tracing backend unless it is `compute`: for people and
  /// tables.
  std::string label() const;
  /// Nanoseconds per timestamp tick; 0 = the queue has no timestamps.
  float timestamp_period_ns() const { return timestamp_period_ns_; }

  /// Warnings and errors of the validation layer so far; empty without validation.
  const std::vector<std::string>& validation_messages() const { return messages_; }
  /// Throws Error with all of them if there are any.
  void check_validation() const;

  /// Returns a memory type among `allowed` that has the `wanted` properties; throws Error if there
  /// is none.
  std::uint32_t memory_type(std::uint32_t allowed, VkMemoryPropertyFlags wanted) const;

  /// Records commands with `record(VkCommandBuffer)`, submits them, and waits until they are done.
  template <class Record>
  void run(Record&& record) {
    VkCommandBuffer commands = begin();
    record(commands);
    end(commands);
  }

 private:
  void create_instance_for(const Options& options);
  void choose_physical(const std::string& select);
  void create_device(const Options& options);
  void create_commands();
  void release();
  VkCommandBuffer begin();
  void end(VkCommandBuffer commands);

  DeviceInfo info_;
  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkPhysicalDeviceMemoryProperties memory_{};
  VkDevice device_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  Trace trace_ = Trace::compute;
  std::uint32_t queue_family_ = 0;
  float timestamp_period_ns_ = 0;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  std::vector<std::string> messages_;
};

/// Makes all earlier writes of shaders and transfers visible to all later reads: the one barrier
/// that a chain of passes needs.
void full_barrier(VkCommandBuffer commands);

}  // namespace nightcity::gpu
