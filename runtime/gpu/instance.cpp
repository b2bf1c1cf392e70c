#include "runtime/gpu/instance.h"

#include "runtime/gpu/vulkan_check.h"

namespace nightcity::gpu {
namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

}  // namespace

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

std::vector<VkPhysicalDevice> list_physical_devices(VkInstance instance) {
  std::uint32_t count = 0;
  VkResult result = vkEnumeratePhysicalDevices(instance, &count, nullptr);
  if (result != VK_SUCCESS) return {};  // a driver that fails here offers no device
  std::vector<VkPhysicalDevice> devices(count);
  result = vkEnumeratePhysicalDevices(instance, &count, devices.data());
  if (result != VK_SUCCESS && result != VK_INCOMPLETE) return {};
  devices.resize(count);
  return devices;
}

}  // namespace nightcity::gpu
