#include "runtime/render/copy_speed.h"

#include <span>
#include <vector>

#include "formats/median.h"
#include "runtime/gpu/buffer.h"
#include "runtime/gpu/compute_pass.h"
#include "runtime/gpu/timer.h"
#include "runtime/render/compile_passes.h"
#include "runtime/render/pass_constants.h"
#include "shaders/frame.h"
#include "spirv/copy_memory.h"

namespace nightcity::render {

double measure_copy_speed(gpu::Device& device) {
  // As many as one dispatch may have: 512 MiB, more than caches of a GPU hold. Those of a CPU hold
  // less than 32.
  constexpr std::uint32_t most = 65535u * WORKGROUP_ROW;
  const std::uint32_t invocations = device.info().kind == "cpu" ? most / 16 : most;
  constexpr int tries = 9;
  const std::size_t bytes = std::size_t{invocations} * COPIED_WORDS * 16;
  gpu::Buffer from(device, bytes), to(device, bytes);
  from.fill_zero();
  to.fill_zero();
  gpu::Frame frame{};
  frame.previous_accumulation = from.address();
  frame.accumulation = to.address();
  gpu::Buffer frame_buffer(device, sizeof frame, gpu::Memory::host);
  frame_buffer.upload(&frame, sizeof frame);
  const gpu::ComputePass pass(device, copy_memory_spirv, PassConstants{}, sizeof(gpu::Push),
                              over_a_list);
  const gpu::Push push{frame_buffer.address(), 0, invocations};
  gpu::Timer timer(device);
  std::vector<double> ms;
  for (int i = 0; i < tries; ++i) {
    device.run([&](VkCommandBuffer commands) {
      timer.start(commands);
      pass.dispatch(commands, &push, invocations);
      timer.mark(commands, "copy");
    });
    const auto spans = timer.collect();
    if (spans.empty()) return 0;
    ms.push_back(gpu::sum_ms(spans));
  }
  const double median_ms = median(ms);
  return median_ms > 0 ? 2.0 * double(bytes) / median_ms * 1000 : 0;
}

}  // namespace nightcity::render
