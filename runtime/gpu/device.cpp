#include "runtime/gpu/device.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <optional>

#include "runtime/gpu/commands.h"
#include "runtime/gpu/instance.h"
#include "runtime/gpu/staging.h"
#include "runtime/gpu/vulkan_check.h"

namespace nightcity::gpu {
namespace {

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data,
                                          void* user) {
  static_cast<std::vector<std::string>*>(user)->emplace_back(data->pMessage);
  return VK_FALSE;
}

// Returns what Linux says programs can still take without swapping. Mesa's CPU driver reports a
// heap of 2 GiB on every machine, and allocates more than that.
std::optional<std::uint64_t> find_available_memory() {
  std::ifstream in("/proc/meminfo");
  for (std::string line; std::getline(in, line);)
    if (line.rfind("MemAvailable:", 0) == 0)
      return std::uint64_t{1024} * std::strtoull(line.c_str() + 13, nullptr, 10);
  return std::nullopt;
}

}  // namespace

Device::Device(const Options& options) {
  try {
    create_instance_for(options);
    choose_physical(options.select);
    create_device(options);
    create_commands();
    pipelines_ = std::make_unique<PipelineStore>(physical_, device_, options.pipeline_folder);
  } catch (...) {
    release();
    throw;
  }
}

void Device::create_instance_for(const Options& options) {
  VkDebugUtilsMessengerCreateInfoEXT messenger{};
  messenger.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
  messenger.messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                              VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                          VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
  messenger.pfnUserCallback = on_message;
  messenger.pUserData = &messages_;

  // The messenger extends the instance, so that messages about its creation arrive too.
  instance_ = create_instance(options.validation, options.instance_extensions,
                              options.validation ? &messenger : nullptr);
  if (!options.validation) return;
  const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
      vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
  VK_CHECK(create(instance_, &messenger, nullptr, &messenger_));
}

void Device::choose_physical(const std::string& select) {
  const std::vector<VkPhysicalDevice> candidates = list_physical_devices(instance_);
  std::vector<DeviceInfo> infos;
  for (const VkPhysicalDevice physical : candidates) infos.push_back(describe_device(physical));
  const std::size_t chosen = choose_device(infos, select);
  info_ = infos[chosen];
  physical_ = candidates[chosen];
  vkGetPhysicalDeviceMemoryProperties(physical_, &memory_);
  queue_family_ = *find_queue_family(physical_);

  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(physical_, &properties);
  timestamp_period_ns_ =
      properties.limits.timestampComputeAndGraphics ? properties.limits.timestampPeriod : 0.0f;
}

void Device::create_device(const Options& options) {
  if (!gpu::has(info_, options.trace))
    throw UsageError("--trace", "device '" + info_.name + "' lacks what '" +
                                    name_of(options.trace) +
                                    "' needs (nightview devices lists which devices have it)");
  trace_ = options.trace;
  max_memory_ = options.max_memory_bytes;
  std::vector<const char*> extensions = options.device_extensions;
  has_budget_ = has_extension(physical_, VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);
  if (has_budget_) extensions.push_back(VK_EXT_MEMORY_BUDGET_EXTENSION_NAME);

  // Features form a chain: 1.0, 1.2, and what the way of tracing needs.
  VkPhysicalDeviceRayTracingPipelineFeaturesKHR pipelines{};
  pipelines.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_TRACING_PIPELINE_FEATURES_KHR;
  pipelines.rayTracingPipeline = VK_TRUE;
  VkPhysicalDeviceRayQueryFeaturesKHR queries{};
  queries.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_RAY_QUERY_FEATURES_KHR;
  queries.rayQuery = VK_TRUE;
  VkPhysicalDeviceAccelerationStructureFeaturesKHR structures{};
  structures.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ACCELERATION_STRUCTURE_FEATURES_KHR;
  structures.accelerationStructure = VK_TRUE;
  VkPhysicalDeviceVulkan12Features v12{};
  v12.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES;
  v12.bufferDeviceAddress = VK_TRUE;
  v12.scalarBlockLayout = VK_TRUE;
  VkPhysicalDeviceFeatures2 features{};
  features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
  features.pNext = &v12;
  features.features.shaderInt64 = VK_TRUE;
  if (trace_ != Trace::compute) {
    const bool query = trace_ == Trace::query;
    v12.pNext = &structures;
    structures.pNext = query ? static_cast<void*>(&queries) : &pipelines;
    extensions.insert(extensions.end(), {VK_KHR_ACCELERATION_STRUCTURE_EXTENSION_NAME,
                                         VK_KHR_DEFERRED_HOST_OPERATIONS_EXTENSION_NAME,
                                         query ? VK_KHR_RAY_QUERY_EXTENSION_NAME
                                               : VK_KHR_RAY_TRACING_PIPELINE_EXTENSION_NAME});
  }

  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue_info{};
  queue_info.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
  queue_info.queueFamilyIndex = queue_family_;
  queue_info.queueCount = 1;
  queue_info.pQueuePriorities = &priority;
  VkDeviceCreateInfo device_info{};
  device_info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
  device_info.pNext = &features;
  device_info.queueCreateInfoCount = 1;
  device_info.pQueueCreateInfos = &queue_info;
  device_info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
  device_info.ppEnabledExtensionNames = extensions.data();
  VK_CHECK(vkCreateDevice(physical_, &device_info, nullptr, &device_));
  vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
}

void Device::create_commands() {
  commands_ = make_commands(device_, queue_family_, pool_);
  VkFenceCreateInfo fence_info{};
  fence_info.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  VK_CHECK(vkCreateFence(device_, &fence_info, nullptr, &fence_));
  staging_ = std::make_unique<Staging>(*this);
}

Device::~Device() {
  release();
}

void Device::release() {
  if (device_) {
    vkDeviceWaitIdle(device_);
    pipelines_.reset();
    staging_.reset();
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

std::uint32_t Device::memory_type(std::uint32_t allowed, VkMemoryPropertyFlags wanted,
                                  VkMemoryPropertyFlags preferred) const {
  for (const VkMemoryPropertyFlags asked : {wanted | preferred, wanted})
    for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i)
      if ((allowed & (1u << i)) && has(i, asked)) return i;
  throw Error("vulkan", "device '" + info_.name + "' has no memory of the kind asked for");
}

bool Device::has(std::uint32_t memory_type, VkMemoryPropertyFlags properties) const {
  return (memory_.memoryTypes[memory_type].propertyFlags & properties) == properties;
}

std::uint64_t Device::free_memory(std::uint32_t memory_type) const {
  const std::uint32_t heap = memory_.memoryTypes[memory_type].heapIndex;
  const auto rest = [](std::uint64_t all, std::uint64_t used) {
    return all > used ? all - used : 0;
  };
  std::uint64_t free = rest(memory_.memoryHeaps[heap].size, taken_);
  if (info_.kind == "cpu") {
    free = find_available_memory().value_or(free);
  } else if (has_budget_) {
    VkPhysicalDeviceMemoryBudgetPropertiesEXT budget{};
    budget.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_BUDGET_PROPERTIES_EXT;
    VkPhysicalDeviceMemoryProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MEMORY_PROPERTIES_2;
    properties.pNext = &budget;
    vkGetPhysicalDeviceMemoryProperties2(physical_, &properties);
    free = rest(budget.heapBudget[heap], budget.heapUsage[heap]);
  }
  return max_memory_ == 0 ? free : std::min(free, rest(max_memory_, taken_));
}

std::uint64_t Device::free_memory() const {
  return free_memory(memory_type(~0u, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT));
}

void Device::take_memory(std::uint32_t memory_type, std::uint64_t bytes) {
  // Asking takes longer than a small allocation.
  constexpr std::uint64_t small = std::uint64_t{1} << 20;
  if ((bytes >= small || max_memory_ != 0) && bytes > free_memory(memory_type))
    refuse_memory(memory_type, bytes);
  taken_ += bytes;
}

void Device::refuse_memory(std::uint32_t memory_type, std::uint64_t bytes) const {
  throw Error("vulkan", "device '" + info_.name + "' has too little memory: " +
                            std::to_string(bytes) + " bytes more are needed, and " +
                            std::to_string(free_memory(memory_type)) + " are free");
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
  {
    const std::lock_guard lock(queue_mutex_);
    VK_CHECK(vkQueueSubmit(queue_, 1, &submit, fence_));
  }
  VK_CHECK(vkWaitForFences(device_, 1, &fence_, VK_TRUE, UINT64_MAX));
  VK_CHECK(vkResetFences(device_, 1, &fence_));
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
