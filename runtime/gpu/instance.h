// The Vulkan loader: an instance, and the devices that it finds.
#pragma once

#include <vulkan/vulkan.h>

#include <vector>

namespace nightcity::gpu {

/// Returns a Vulkan 1.2 instance with these extensions, and with the validation layer if asked for.
/// `next` extends its create info. Throws Error, with the Debian package to install, if there is no
/// driver or no validation layer.
VkInstance create_instance(bool validation, std::vector<const char*> extensions, const void* next);

/// Returns the instance's devices, in the loader's order.
std::vector<VkPhysicalDevice> list_physical_devices(VkInstance instance);

}  // namespace nightcity::gpu
