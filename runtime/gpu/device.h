// A Vulkan device with one compute-and-graphics queue, chosen by name or index.
#pragma once

#include <vulkan/vulkan.h>

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "runtime/gpu/device_info.h"
#include "runtime/gpu/pipeline_store.h"

namespace nightcity::gpu {

class Staging;

class Device {
 public:
  struct Options {
    std::string
        select;  // "" = the best usable device; else an index, or part of a name in any case
    bool validation = false;
    Trace trace = Trace::compute;                    // refused if the device lacks it
    std::vector<const char*> instance_extensions{};  // required by a window system
    std::vector<const char*> device_extensions{};
    std::filesystem::path pipeline_folder{};  // where compiled pipelines are kept; "" = nowhere
    std::uint64_t max_memory_bytes = 0;       // taken from the device at most; 0 = all of it
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
  /// Held while commands are submitted to the queue or a picture is presented on it: threads share
  /// the queue.
  std::mutex& queue_mutex() { return queue_mutex_; }
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

  /// Returns a memory type among `allowed` that has the `wanted` properties, and the `preferred`
  /// ones too where one has both; throws Error if there is none.
  std::uint32_t memory_type(std::uint32_t allowed, VkMemoryPropertyFlags wanted,
                            VkMemoryPropertyFlags preferred = 0) const;

  /// Returns whether a memory type has all of these properties.
  bool has(std::uint32_t memory_type, VkMemoryPropertyFlags properties) const;

  /// Returns how many bytes can still be allocated: what the driver reports as this program's
  /// budget (VK_EXT_memory_budget), or else the size of the heap less what was taken. On a CPU
  /// driver it is what the system has left.
  std::uint64_t free_memory(std::uint32_t memory_type) const;
  /// The same for memory that only the device reads.
  std::uint64_t free_memory() const;
  /// Counts bytes about to be allocated; throws as refuse_memory where there are not as many. A CPU
  /// driver hands out more than there is, and the system would end the program later.
  void take_memory(std::uint32_t memory_type, std::uint64_t bytes);
  /// Returns the bytes that this program has allocated.
  std::uint64_t taken_memory() const { return taken_; }
  void give_memory_back(std::uint64_t bytes) { taken_ -= bytes; }
  /// Throws Error with the bytes that are needed and those that are free.
  [[noreturn]] void refuse_memory(std::uint32_t memory_type, std::uint64_t bytes) const;

  /// Returns the memory that transfers go through.
  Staging& staging() { return *staging_; }

  /// Returns what pipelines are compiled with.
  VkPipelineCache pipelines() const { return pipelines_ ? pipelines_->handle() : VK_NULL_HANDLE; }
  const PipelineStore* pipeline_store() const { return pipelines_.get(); }

  /// Records commands with `record(VkCommandBuffer)`, submits them, and waits until they are done.
  /// Threads take turns.
  template <class Record>
  void run(Record&& record) {
    const std::lock_guard turn(run_mutex_);
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
  std::mutex queue_mutex_, run_mutex_;
  Trace trace_ = Trace::compute;
  std::uint32_t queue_family_ = 0;
  float timestamp_period_ns_ = 0;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  std::vector<std::string> messages_;
  bool has_budget_ = false;
  std::uint64_t max_memory_ = 0;
  std::atomic<std::uint64_t> taken_ = 0;
  std::unique_ptr<PipelineStore> pipelines_;
  std::unique_ptr<Staging> staging_;
};

/// Makes all earlier writes of shaders and transfers visible to all later reads: the one barrier
/// that a chain of passes needs.
void full_barrier(VkCommandBuffer commands);

}  // namespace nightcity::gpu
