#include "runtime/gpu/device.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <optional>

#include "runtime/gpu/vulkan_check.h"

namespace nightcity::gpu {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data,
                                          void* user) {
  static_cast<std::vector<std::string>*>(user)->emplace_back(data->pMessage);
  return VK_FALSE;
}

VkInstance create_instance(bool validation, std::vector<const char*> extensions, const void* next) {
  const VkApplicationInfo application{.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                      .pNext = nullptr,
                                      .pApplicationName = "nightview",
                                      .applicationVersion = 1,
                                      .pEngineName = "nightcity",
                                      .engineVersion = 1,
                                      .apiVersion = VK_API_VERSION_1_2};
  if (validation) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  VkInstanceCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
  info.pNext = next;
  info.pApplicationInfo = &application;
  info.enabledLayerCount = validation ? 1 : 0;
  info.ppEnabledLayerNames = &validation_layer;
  info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  VkInstance instance = VK_NULL_HANDLE;
  const VkResult result = vkCreateInstance(&info, nullptr, &instance);
  if (result == VK_ERROR_LAYER_NOT_PRESENT)
    throw Error("vulkan",
                "the validation layer is not installed (Debian package vulkan-validationlayers)");
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER || result == VK_ERROR_INITIALIZATION_FAILED)
    throw Error(
        "vulkan",
        "no Vulkan driver is installed (Debian package mesa-vulkan-drivers has one for the CPU)");
  check(result, "vkCreateInstance");
  return instance;
}

std::vector<VkPhysicalDevice> physical_devices(VkInstance instance) {
  std::uint32_t count = 0;
  VkResult result = vkEnumeratePhysicalDevices(instance, &count, nullptr);
  if (result != VK_SUCCESS) return {};  // a driver that fails here offers nothing
  std::vector<VkPhysicalDevice> devices(count);
  result = vkEnumeratePhysicalDevices(instance, &count, devices.data());
  if (result != VK_SUCCESS && result != VK_INCOMPLETE) return {};
  devices.resize(count);
  return devices;
}

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

DeviceInfo describe(VkPhysicalDevice physical) {
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

  std::uint32_t count = 0;
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateDeviceExtensionProperties(physical, nullptr, &count, extensions.data());
  const auto has = [&](const char* name) {
    return std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& e) {
      return std::strcmp(e.extensionName, name) == 0;
    });
  };
  info.ray_query = has(VK_KHR_RAY_QUERY_EXTENSION_NAME);
  info.ray_pipeline = has(VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME);

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

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

int rank(const DeviceInfo& info) {
  if (!info.usable) return -1;
  if (info.kind == "discrete") return 4;
  if (info.kind == "integrated") return 3;
  if (info.kind == "virtual") return 2;
  return 1;
}

std::size_t choose(const std::vector<DeviceInfo>& devices, const std::string& select) {
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
    if (lower(devices[i].name).find(lower(select)) != std::string::npos) return refuse_unusable(i);
  throw UsageError("--device", "no Vulkan device matches '" + select + "' (see nightview devices)");
}

}  // namespace

const char* result_name(VkResult result) {
  switch (result) {
    case VK_SUCCESS:
      return "VK_SUCCESS";
    case VK_NOT_READY:
      return "VK_NOT_READY";
    case VK_TIMEOUT:
      return "VK_TIMEOUT";
    case VK_INCOMPLETE:
      return "VK_INCOMPLETE";
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "VK_ERROR_OUT_OF_HOST_MEMORY";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "VK_ERROR_OUT_OF_DEVICE_MEMORY";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "VK_ERROR_INITIALIZATION_FAILED";
    case VK_ERROR_DEVICE_LOST:
      return "VK_ERROR_DEVICE_LOST";
    case VK_ERROR_MEMORY_MAP_FAILED:
      return "VK_ERROR_MEMORY_MAP_FAILED";
    case VK_ERROR_LAYER_NOT_PRESENT:
      return "VK_ERROR_LAYER_NOT_PRESENT";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
      return "VK_ERROR_EXTENSION_NOT_PRESENT";
    case VK_ERROR_FEATURE_NOT_PRESENT:
      return "VK_ERROR_FEATURE_NOT_PRESENT";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "VK_ERROR_INCOMPATIBLE_DRIVER";
    case VK_ERROR_SURFACE_LOST_KHR:
      return "VK_ERROR_SURFACE_LOST_KHR";
    case VK_ERROR_OUT_OF_DATE_KHR:
      return "VK_ERROR_OUT_OF_DATE_KHR";
    case VK_SUBOPTIMAL_KHR:
      return "VK_SUBOPTIMAL_KHR";
    default:
      return "an unnamed VkResult";
  }
}

std::vector<DeviceInfo> list_devices() {
  const VkInstance instance = create_instance(false, {}, nullptr);
  std::vector<DeviceInfo> infos;
  for (const VkPhysicalDevice physical : physical_devices(instance))
    infos.push_back(describe(physical));
  vkDestroyInstance(instance, nullptr);
  return infos;
}

Device::Device(const Options& options) {
  VkDebugUtilsMessengerCreateInfoEXT messenger{};
  messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                              VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                          VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  messenger.pfnUserCallback = on_message;
  messenger.pUserData = &messages_;

  instance_ = create_instance(options.validation, options.instance_extensions,
                              options.validation ? &messenger : nullptr);
  try {
    if (options.validation) {
      const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
          vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
      VK_CHECK(create(instance_, &messenger, nullptr, &messenger_));
    }
    const std::vector<VkPhysicalDevice> candidates = physical_devices(instance_);
    std::vector<DeviceInfo> infos;
    for (const VkPhysicalDevice physical : candidates) infos.push_back(describe(physical));
    const std::size_t chosen = choose(infos, options.select);
    info_ = infos[chosen];
    physical_ = candidates[chosen];
    vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
    queue_family_ = *find_queue_family(physical_);

    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(physical_, &properties);
    timestamp_period_ns_ =
        properties.limits.timestampComputeAndGraphics ? properties.limits.timestampPeriod : 0.0f;

    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue_info{};
    queue_info.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue_info.queueFamilyIndex = queue_family_;
    queue_info.queueCount = 1;
    queue_info.pQueuePriorities = &priority;

    VkPhysicalDeviceVulkan12Features v12{};
    v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
    v12.bufferDeviceAddress = VK_TRUE;
    v12.scalarBlockLayout = VK_TRUE;
    VkPhysicalDeviceFeatures2 features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &v12;
    features.features.shaderInt64 = VK_TRUE;

    std::vector<const char*> extensions = options.device_extensions;
    VkPhysicalDeviceAccelerationStructureFeaturesKHR trees{};
    trees.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR;
    trees.accelerationStructure = VK_TRUE;
    VkPhysicalDeviceRayTracingPipelineFeaturesKHR rays{};
    rays.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR;
    rays.rayTracingPipeline = VK_TRUE;
    VkPhysicalDeviceRayQueryFeaturesKHR queries{};
    queries.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR;
    queries.rayQuery = VK_TRUE;
    if (!has(info_, options.trace))
      throw UsageError("--trace", "device '" + info_.name + "' lacks what '" +
                                      name_of(options.trace) +
                                      "' needs (nightview devices tells which have it)");
    trace_ = options.trace;
    if (trace_ != Trace::compute) {
      const bool query = trace_ == Trace::query;
      v12.pNext = &trees;
      trees.pNext = query ? static_cast<void*>(&queries) : &rays;
      extensions.insert(extensions.end(), {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                           VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME,
                                           query ? VK_KHR_RAY_QUERY_EXTENSION_NAME
                                                 : VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME});
    }

    VkDeviceCreateInfo device_info{};
    device_info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    device_info.pNext = &features;
    device_info.queueCreateInfoCount = 1;
    device_info.pQueueCreateInfos = &queue_info;
    device_info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    device_info.ppEnabledExtensionNames = extensions.data();
    VK_CHECK(vkCreateDevice(physical_, &device_info, nullptr, &device_));
    vkGetDeviceQueue(device_, queue_family_, 0, &queue_);

    VkCommandPoolCreateInfo pool_info{};
    pool_info.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
    pool_info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool_info.queueFamilyIndex = queue_family_;
    VK_CHECK(vkCreateCommandPool(device_, &pool_info, nullptr, &pool_));
    VkCommandBufferAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
    allocate.commandPool = pool_;
    allocate.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocate.commandBufferCount = 1;
    VK_CHECK(vkAllocateCommandBuffers(device_, &allocate, &commands_));
    VkFenceCreateInfo fence_info{};
    fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
    VK_CHECK(vkCreateFence(device_, &fence_info, nullptr, &fence_));
  } catch (...) {
    release();
    throw;
  }
}

Device::~Device() {
  release();
}

void Device::release() {
  if (device_) {
    vkDeviceWaitIdle(device_);
    vkDestroyFence(device_, fence_, nullptr);
    vkDestroyCommandPool(device_, pool_, nullptr);
    vkDestroyDevice(device_, nullptr);
  }
  if (messenger_) {
    const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"));
    destroy(instance_, messenger_, nullptr);
  }
  if (instance_) vkDestroyInstance(instance_, nullptr);
}

std::uint32_t Device::memory_type(std::uint32_t allowed, VkMemoryPropertyFlags wanted) const {
  for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i)
    if ((allowed & (1u << i)) && (memory_.memoryTypes[i].propertyFlags & wanted) == wanted)
      return i;
  throw Error("vulkan", "device '" + info_.name + "' has no memory of the kind asked for");
}

VkCommandBuffer Device::begin() {
  VkCommandBufferBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  VK_CHECK(vkBeginCommandBuffer(commands_, &info));
  return commands_;
}

void Device::end(VkCommandBuffer commands) {
  VK_CHECK(vkEndCommandBuffer(commands));
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands;
  VK_CHECK(vkQueueSubmit(queue_, 1, &submit, fence_));
  VK_CHECK(vkWaitForFences(device_, 1, &fence_, VK_TRUE, UINT64_MAX));
  VK_CHECK(vkResetFences(device_, 1, &fence_));
}

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

std::string Device::label() const {
  return info_.name + (trace_ == Trace::compute ? "" : std::string(", --trace ") + name_of(trace_));
}

void Device::check_validation() const {
  if (messages_.empty()) return;
  std::string all = "the validation layer found fault";
  for (const std::string& message : messages_) all += "\n" + message;
  throw Error("vulkan", all);
}

void full_barrier(VkCommandBuffer commands) {
  VkMemoryBarrier barrier{};
  barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
  barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
  barrier.dstAccessMask =
      VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT | VK_ACCESS_HOST_READ_BIT;
  vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                       VK_PIPELINE_STAGE_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_HOST_BIT, 0, 1,
                       &barrier, 0, nullptr, 0, nullptr);
}

}  // namespace nightcity::gpu
