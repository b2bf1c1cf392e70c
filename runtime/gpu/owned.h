// Vulkan handles that are destroyed with their owner. They are moved, not copied.
#pragma once

#include <vulkan/vulkan.h>

#include <memory>
#include <type_traits>

namespace nightcity::gpu {

template <auto destroy>
struct DestroyedBy {
  VkDevice device = VK_NULL_HANDLE;
  template <class Handle>
  void operator()(Handle handle) const {
    destroy(device, handle, nullptr);
  }
};

template <class Handle, auto destroy>
using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, DestroyedBy<destroy>>;

}  // namespace nightcity::gpu
