#include "runtime/gpu/timer.h"

#include "runtime/gpu/vulkan_check.h"

namespace nightcity::gpu {

Timer::Timer(Device& device) : device_(device) {
  if (device.timestamp_period_ns() == 0) return;
  VkQueryPoolCreateInfo info{};
  info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
  info.queryType = VK_QUERY_TYPE_TIMESTAMP;
  info.queryCount = capacity;
  VK_CHECK(vkCreateQueryPool(device.handle(), &info, nullptr, &pool_));
}

Timer::~Timer() {
  vkDestroyQueryPool(device_.handle(), pool_, nullptr);
}

void Timer::start(VkCommandBuffer commands) {
  names_.clear();
  if (!pool_) return;
  vkCmdResetQueryPool(commands, pool_, 0, capacity);
  vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool_, 0);
}

void Timer::mark(VkCommandBuffer commands, const char* name) {
  if (!pool_ || names_.size() + 1 >= capacity) return;
  names_.push_back(name);
  vkCmdWriteTimestamp(commands, VK_PIPELINE_STAGE_BOTTOM_OF_PIPE_BIT, pool_,
                      static_cast<std::uint32_t>(names_.size()));
}

std::vector<Timer::Span> Timer::collect() {
  if (!pool_ || names_.empty()) return {};
  std::vector<std::uint64_t> ticks(names_.size() + 1);
  VK_CHECK(vkGetQueryPoolResults(
      device_.handle(), pool_, 0, static_cast<std::uint32_t>(ticks.size()),
      ticks.size() * sizeof(std::uint64_t), ticks.data(), sizeof(std::uint64_t),
      VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT));
  std::vector<Span> spans;
  for (std::size_t i = 0; i < names_.size(); ++i)
    spans.push_back({names_[i], double(ticks[i + 1] - ticks[i]) *
                                    double(device_.timestamp_period_ns()) * 1e-6});
  return spans;
}

double sum_ms(std::span<const Timer::Span> spans) {
  double sum = 0;
  for (const Timer::Span& span : spans) sum += span.ms;
  return sum;
}

}  // namespace nightcity::gpu
