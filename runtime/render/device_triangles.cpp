#include "runtime/render/device_triangles.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "formats/parallel.h"
#include "formats/touch_pages.h"

namespace nightcity::render {
namespace {

// Pages of the file that triangles are read from are given back whenever that many were read.
constexpr std::size_t resident_triangles = 1 << 18;

bool is_traced_by_us(const gpu::Device& device) {
  return device.trace() == gpu::Trace::compute;
}

}  // namespace

std::size_t count_device_triangles(const gpu::Device& device, const scene::RenderScene& scene) {
  return is_traced_by_us(device) ? scene.triangle_order.size() : scene.triangles.size();
}

std::span<const std::uint32_t> order_triangles(const gpu::Device& device,
                                               const scene::RenderScene& scene,
                                               LargeVector<std::uint32_t>& once) {
  if (is_traced_by_us(device)) return scene.triangle_order;
  once.resize(scene.triangles.size());
  std::iota(once.begin(), once.end(), 0u);
  return once;
}

gpu::Buffer upload_triangles(gpu::Device& device, const scene::RenderScene& scene,
                             std::span<const std::uint32_t> order) {
  gpu::Buffer buffer(device, order.size() * sizeof(gpu::Triangle));
  std::atomic<std::size_t> read = 0;
  buffer.make_first<gpu::Triangle>(
      order.size(), [&](std::span<gpu::Triangle> to, std::size_t first) {
        constexpr std::size_t piece = 1 << 14;
        run_parallel((to.size() + piece - 1) / piece, count_cores(), [&](std::size_t i) {
          const std::size_t begin = i * piece, count = std::min(piece, to.size() - begin);
          touch_pages(to.subspan(begin, count));
          scene.triangles.gather(order.subspan(first + begin, count), to.subspan(begin, count));
          if ((read += piece) % resident_triangles == 0) scene.triangles.release_pages();
        });
      });
  scene.triangles.release_pages();
  return buffer;
}

}  // namespace nightcity::render
