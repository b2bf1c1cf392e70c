// A Vulkan device with one compute-and-graphics queue, chosen by name or index.
#pragma once

#include <vulkan/vulkan.h>

#include <cstdint>
#include <string>
#include <vector>

namespace nightcity::gpu {

/// What one Vulkan device offers, as far as we care.
struct DeviceInfo {
  std::string name;
  std::string driver;  // driver name and version text
  std::string kind;    // "discrete", "integrated", "virtual", "cpu", "other"
  std::uint32_t api_version = 0;
  std::uint64_t memory_bytes = 0;  // the largest device-local heap
  std::uint32_t subgroup_size = 0;
  bool usable =
      false;  // has all we need: Vulkan 1.2, buffer device addresses, scalar layout, 64-bit integers
  std::string missing;        // why not usable; "" = usable
  bool ray_query = false;     // VK_KHR_ray_query
  bool ray_pipeline = false;  // VK_KHR_ray_tracing_pipeline
};

/// How rays meet a scene. All but the first go through the device's acceleration structures.
enum class Trace {
  compute,   // our own hierarchy: every device
  query,     // VK_KHR_ray_query
  pipeline,  // VK_KHR_ray_tracing_pipeline
};

const char* name_of(Trace trace);
/// Throws UsageError where there is no such way.
Trace trace_from_name(const std::string& name);
bool has(const DeviceInfo& device, Trace trace);

/// Every Vulkan device of this machine, in the loader's order. Throws Error when there is no Vulkan at all.
std::vector<DeviceInfo> list_devices();

class Device {
 public:
  struct Options {
    std::string select;  // "" = best usable one; an index, or part of a name in any case
    bool validation = false;
    Trace trace = Trace::compute;                  // refused where the device lacks it
    std::vector<const char*> instance_extensions;  // what a window system asks for
    std::vector<const char*> device_extensions;
  };

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
  /// For people and tables: its name, and the way that rays take where that is not the usual one.
  std::string label() const;
  float timestamp_period_ns() const {
    return timestamp_period_ns_;
  }  // 0 = the queue has no timestamps

  /// What the validation layer has said so far (warnings and errors); empty without validation.
  const std::vector<std::string>& validation_messages() const { return messages_; }
  /// Throws Error with all of it where there is any.
  void check_validation() const;

  /// Memory type with `wanted` properties among `allowed`; throws Error where there is none.
  std::uint32_t memory_type(std::uint32_t allowed, VkMemoryPropertyFlags wanted) const;

  /// Records with `record(VkCommandBuffer)`, submits, and waits until the queue is done.
  template <class Record>
  void run(Record&& record) {
    VkCommandBuffer commands = begin();
    record(commands);
    end(commands);
  }

 private:
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

/// All writes of shaders and transfers before are visible to all reads after: the one barrier a chain of
/// passes needs.
void full_barrier(VkCommandBuffer commands);

}  // namespace nightcity::gpu
