#include "runtime/viewer/frame_stats.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>

namespace nightcity::viewer {

void describe_city(const City& city, FrameStats& stats) {
  const scene::RenderScene& scene = city.scene;
  stats.scene = name_of(city.path);
  stats.triangles = city.triangles;
  stats.lights = scene.lights.size();
  stats.has_light = !scene.lights.empty() || !scene.traffic.trips.empty();
  stats.licences = scene.georeference.licences;
}

void describe_picture(const LivePicture& picture, FrameStats& stats) {
  const render::Renderer& renderer = picture.renderer();
  stats.width = renderer.width();
  stats.height = renderer.height();
  stats.divisor = picture.shown().divisor;
  stats.frames = renderer.frames();
  stats.made_with = picture.made_with();
  stats.passes = renderer.timings();
  stats.frame_ms = 1000 * renderer.frame_s();
  stats.pace = picture.pace().describe();
  constexpr std::size_t most = 100;
  if (stats.times_ms.size() == most) stats.times_ms.erase(stats.times_ms.begin());
  stats.times_ms.push_back(static_cast<float>(stats.frame_ms));
}

std::string describe_reference(const render::Renderer& renderer) {
  const std::uint32_t frames = renderer.frames();
  return fmt::format("the reference: {} frame{} of {} x {}", frames, frames == 1 ? "" : "s",
                     renderer.width(), renderer.height());
}

void describe_memory(const gpu::Device& device, FrameStats& stats) {
  stats.device_bytes = device.taken_memory();
  std::ifstream statm("/proc/self/statm");  // in pages: all, then resident
  std::uint64_t all = 0, resident = 0;
  if (statm >> all >> resident)
    stats.process_bytes = resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

}  // namespace nightcity::viewer
