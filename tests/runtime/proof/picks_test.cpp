// Lights are picked by whole random numbers. Each number has to have the probability that the
// weight of its sample is divided by, however many lights there are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "runtime/gpu/buffer.h"
#include "runtime/gpu/compute_pass.h"
#include "spirv/pick_probe.h"
#include "support/gpu.h"

namespace nightcity::test {
namespace {

constexpr double words = 4294967296.0;

// Returns by how many of the 2^32 words each of the numbers 0, step, 2 step, ... below n is picked.
std::vector<std::uint32_t> words_of_picks(std::uint32_t n, std::uint32_t step) {
  gpu::Device& device = test_device();
  const std::uint32_t count = (n + step - 1) / step;
  gpu::Buffer counts(device, count * sizeof(std::uint32_t));
  struct Push {
    std::uint64_t counts;
    std::uint32_t n, step;
  } const push{counts.address(), n, step};
  const gpu::ComputePass probe(device, pick_probe_spirv, {}, sizeof(push));
  device.run([&](VkCommandBuffer commands) {
    probe.dispatch(commands, &push, count);
    gpu::full_barrier(commands);
  });
  return counts.read<std::uint32_t>(count);
}

TEST(Picks, AreUniformToAWordOf32Bits) {
  for (const auto& [n, step] :
       {std::pair{3u, 1u}, {1000u, 1u}, {1000003u, 17u}, {10000000u, 997u}}) {
    const std::vector<std::uint32_t> counts = words_of_picks(n, step);
    const auto [least, most] = std::minmax_element(counts.begin(), counts.end());
    EXPECT_GE(*least, words / n - 1) << n;
    EXPECT_LE(*most, words / n + 1) << n;
  }
}

}  // namespace
}  // namespace nightcity::test
