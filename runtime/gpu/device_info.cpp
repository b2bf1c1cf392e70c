#include "runtime/gpu/device_info.h"

#include <algorithm>
#include <cctype>
#include <cstring>

#include "formats/error.h"
#include "formats/to_lower.h"
#include "runtime/gpu/instance.h"

namespace nightcity::gpu {
namespace {

const char* kind_name(VkPhysicalDeviceType type) {
  switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
      return "discrete";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
      return "integrated";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
      return "virtual";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
      return "cpu";
    default:
      return "other";
  }
}

int rank(const DeviceInfo& info) {
  if (!info.usable) return -1;
  if (info.kind == "discrete") return 4;
  if (info.kind == "integrated") return 3;
  if (info.kind == "virtual") return 2;
  return 1;
}

}  // namespace

const char* name_of(Trace trace) {
  switch (trace) {
    case Trace::compute:
      return "compute";
    case Trace::query:
      return "query";
    case Trace::pipeline:
      return "pipeline";
  }
  return "?";
}

Trace trace_from_name(const std::string& name) {
  for (const Trace trace : {Trace::compute, Trace::query, Trace::pipeline})
    if (name == name_of(trace)) return trace;
  throw UsageError("--trace", "expected compute, query or pipeline, not '" + name + "'");
}

bool has(const DeviceInfo& device, Trace trace) {
  return trace == Trace::compute ||
         (trace == Trace::query ? device.ray_query : device.ray_pipeline);
}

std::optional<std::uint32_t> find_queue_family(VkPhysicalDevice physical) {
  std::uint32_t count = 0;
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, nullptr);
  std::vector<VkQueueFamilyProperties> families(count);
  vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families.data());
  // A graphics queue also presents and draws the panel; headless servers may offer compute only.
  for (const VkQueueFlags wanted : {VkQueueFlags(VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT),
                                    VkQueueFlags(VK_QUEUE_COMPUTE_BIT)})
    for (std::uint32_t i = 0; i < count; ++i)
      if ((families[i].queueFlags & wanted) == wanted) return i;
  return std::nullopt;
}

bool has_extension(VkPhysicalDevice physical, const char* name) {
  std::uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
  return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& e) {
    return std::strcmp(e.extensionName, name) == 0;
  });
}

DeviceInfo describe_device(VkPhysicalDevice physical) {
  VkPhysicalDeviceSubgroupProperties subgroup{};
  subgroup.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SUBGROUP_PROPERTIES;
  VkPhysicalDeviceDriverProperties driver{};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  driver.pNext = &subgroup;
  VkPhysicalDeviceProperties2 properties{};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &driver;
  vkGetPhysicalDeviceProperties2(physical, &properties);

  DeviceInfo info;
  info.name = properties.properties.deviceName;
  info.driver = std::string(driver.driverName) + " " + driver.driverInfo;
  info.kind = kind_name(properties.properties.deviceType);
  info.api_version = properties.properties.apiVersion;
  info.subgroup_size = subgroup.subgroupSize;

  VkPhysicalDeviceMemoryProperties memory{};
  vkGetPhysicalDeviceMemoryProperties(physical, &memory);
  for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i)
    if (memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT)
      info.memory_bytes = std::max<std::uint64_t>(info.memory_bytes, memory.memoryHeaps[i].size);

  info.ray_query = has_extension(physical, VK_KHR_RAY_QUERY_EXTENSION_NAME);
  info.ray_pipeline = has_extension(physical, VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME);

  if (info.api_version < VK_API_VERSION_1_2) {
    info.missing = "Vulkan 1.2";
    return info;
  }
  VkPhysicalDeviceVulkan12Features v12{};
  v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  VkPhysicalDeviceFeatures2 features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  features.pNext = &v12;
  vkGetPhysicalDeviceFeatures2(physical, &features);
  if (!v12.bufferDeviceAddress)
    info.missing = "buffer device addresses";
  else if (!v12.scalarBlockLayout)
    info.missing = "scalar block layout";
  else if (!features.features.shaderInt64)
    info.missing = "64-bit integers in shaders";
  else if (!find_queue_family(physical))
    info.missing = "a compute queue";
  info.usable = info.missing.empty();
  return info;
}

std::size_t choose_device(const std::vector<DeviceInfo>& devices, const std::string& select) {
  const auto refuse_unusable = [&](std::size_t i) {
    if (!devices[i].usable)
      throw Error("vulkan", "device '" + devices[i].name + "' lacks " + devices[i].missing);
    return i;
  };
  if (devices.empty())
    throw Error("vulkan",
                "no Vulkan device (Debian package mesa-vulkan-drivers has one for the CPU)");
  if (select.empty()) {
    std::size_t best = 0;
    for (std::size_t i = 1; i < devices.size(); ++i)
      if (rank(devices[i]) > rank(devices[best])) best = i;
    return refuse_unusable(best);
  }
  if (std::all_of(select.begin(), select.end(), [](unsigned char c) { return std::isdigit(c); }) &&
      select.size() < 4) {
    const std::size_t index = std::stoul(select);
    if (index < devices.size()) return refuse_unusable(index);
  }
  for (std::size_t i = 0; i < devices.size(); ++i)
    if (to_lower(devices[i].name).find(to_lower(select)) != std::string::npos)
      return refuse_unusable(i);
  throw UsageError("--device", "no Vulkan device matches '" + select + "' (see nightview devices)");
}

std::vector<DeviceInfo> list_devices() {
  const VkInstance instance = create_instance(false, {}, nullptr);
  std::vector<DeviceInfo> infos;
  for (const VkPhysicalDevice physical : list_physical_devices(instance))
    infos.push_back(describe_device(physical));
  vkDestroyInstance(instance, nullptr);
  return infos;
}

}  // namespace nightcity::gpu
