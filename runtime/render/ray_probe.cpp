#include "runtime/render/ray_probe.h"

#include <chrono>

#include "runtime/gpu/timer.h"

namespace nightcity::render {

TracedRays trace_rays(gpu::Device& device, PassLibrary& library, DeviceScene& scene,
                      std::span<const gpu::ProbeRay> rays, bool any_hit, std::uint32_t repeats) {
  const auto count = static_cast<std::uint32_t>(rays.size());
  const TracePass& pass = library.rays(PassConstants{}, any_hit);
  const gpu::Buffer sent = gpu::Buffer::of(device, rays);
  gpu::Buffer distances(device, count * sizeof(float));
  gpu::Frame frame{};
  frame.scene = scene.buffers();
  if (scene.has_traffic()) frame.scene.root = frame.scene.traffic.static_root;
  frame.probe = {sent.address(), distances.address()};
  gpu::Buffer frame_buffer(device, sizeof frame, gpu::Memory::host);
  frame_buffer.upload(&frame, sizeof frame);
  const gpu::Push push{frame_buffer.address(), 0, count};
  gpu::Timer timer(device);
  TracedRays result;
  for (std::uint32_t i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    device.run([&](VkCommandBuffer commands) {
      timer.start(commands);
      pass.dispatch(commands, &push, count);
      timer.mark(commands, "rays");
    });
    const std::chrono::duration<double, std::milli> wall = std::chrono::steady_clock::now() - start;
    const auto spans = timer.collect();
    result.ms.push_back(spans.empty() ? wall.count() : gpu::sum_ms(spans));
  }
  result.distances = distances.read<float>(count);
  return result;
}

}  // namespace nightcity::render
