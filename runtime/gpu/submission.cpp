#include "runtime/gpu/submission.h"

#include <algorithm>
#include <limits>

#include "runtime/gpu/commands.h"
#include "runtime/gpu/vulkan_check.h"

namespace nightcity::gpu {
namespace {

constexpr double for_ever = std::numeric_limits<double>::infinity();

std::uint64_t to_nanoseconds(double seconds) {
  constexpr double most = 1e18;  // 30 years
  return static_cast<std::uint64_t>(std::clamp(seconds * 1e9, 0.0, most));
}

}  // namespace

Submission::Submission(Device& device) : device_(device) {
  commands_ = make_commands(device.handle(), device.queue_family(), pool_);
  VkFenceCreateInfo fence{};
  fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
  VK_CHECK(vkCreateFence(device.handle(), &fence, nullptr, &fence_));
}

Submission::~Submission() {
  if (running_) vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, UINT64_MAX);
  vkDestroyFence(device_.handle(), fence_, nullptr);
  vkDestroyCommandPool(device_.handle(), pool_, nullptr);
}

VkCommandBuffer Submission::begin() {
  wait(for_ever);
  VkCommandBufferBeginInfo info{};
  info.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
  info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
  VK_CHECK(vkBeginCommandBuffer(commands_, &info));
  return commands_;
}

void Submission::submit() {
  VK_CHECK(vkEndCommandBuffer(commands_));
  VkSubmitInfo submit{};
  submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
  submit.commandBufferCount = 1;
  submit.pCommandBuffers = &commands_;
  const std::lock_guard lock(device_.queue_mutex());
  VK_CHECK(vkQueueSubmit(device_.queue(), 1, &submit, fence_));
  running_ = true;
}

bool Submission::wait(double seconds) {
  if (!running_) return true;
  const VkResult result =
      vkWaitForFences(device_.handle(), 1, &fence_, VK_TRUE, to_nanoseconds(seconds));
  if (result == VK_TIMEOUT) return false;
  check(result, "vkWaitForFences");
  running_ = false;
  VK_CHECK(vkResetFences(device_.handle(), 1, &fence_));
  return true;
}

}  // namespace nightcity::gpu
