// The Vulkan devices of this machine: what each offers, and which one a user means.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nightcity::gpu {

/// The features of a Vulkan device that this program uses.
struct DeviceInfo {
  std::string name;
  std::string driver;  // name and version of the driver
  std::string kind;    // "discrete", "integrated", "virtual", "cpu", "other"
  std::uint32_t api_version = 0;
  std::uint64_t memory_bytes = 0;  // the largest device-local heap
  std::uint32_t subgroup_size = 0;
  // The device has all that is required: Vulkan 1.2, buffer device addresses, scalar block layout,
  // 64-bit integers.
  bool usable = false;
  std::string missing;        // the first thing it lacks; "" = usable
  bool ray_query = false;     // VK_KHR_ray_query
  bool ray_pipeline = false;  // VK_KHR_ray_tracing_pipeline
};

/// The ways of tracing rays. All but the first use the device's acceleration structures.
enum class Trace {
  compute,   // our own BVH: every device
  query,     // VK_KHR_ray_query
  pipeline,  // VK_KHR_ray_tracing_pipeline
};

const char* name_of(Trace trace);
/// Throws UsageError for a name that is none.
Trace trace_from_name(const std::string& name);
bool has(const DeviceInfo& device, Trace trace);

/// Returns every Vulkan device of this machine, in the loader's order. Throws Error if there is no
/// Vulkan at all.
std::vector<DeviceInfo> list_devices();

/// Returns whether a device offers an extension of the device.
bool has_extension(VkPhysicalDevice physical, const char* name);

DeviceInfo describe_device(VkPhysicalDevice physical);

/// Returns the index of the device that `select` names: an index, part of a name in any case, or ""
/// for the best usable one. Throws UsageError if none matches, Error if it is not usable.
std::size_t choose_device(const std::vector<DeviceInfo>& devices, const std::string& select);

/// Returns a queue family for compute, preferably one for graphics too.
std::optional<std::uint32_t> find_queue_family(VkPhysicalDevice physical);

}  // namespace nightcity::gpu
