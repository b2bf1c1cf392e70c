// Turns Vulkan's result codes into errors that name the call.
#pragma once

#include <vulkan/vulkan.h>

#include <string>

#include "formats/error.h"

namespace nightcity::gpu {

/// Returns the name of a result code, "VK_ERROR_DEVICE_LOST" for example.
const char* result_name(VkResult result);

inline void check(VkResult result, const char* call) {
  if (result != VK_SUCCESS)
    throw Error("vulkan", std::string(call) + " failed with " + result_name(result));
}

}  // namespace nightcity::gpu

#define VK_CHECK(call) ::nightcity::gpu::check(call, #call)
