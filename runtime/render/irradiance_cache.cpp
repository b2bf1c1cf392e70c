#include "runtime/render/irradiance_cache.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace nightcity::render {
namespace {

// The longest time for which a cell remembers light that moves, s of the scene.
constexpr double memory_s = 0.5;

// The longest mean of a cell where nothing moves, in samples: more would be lost to rounding.
constexpr float max_samples = 65536;

std::uint32_t cells_for(std::size_t pixels) {
  return static_cast<std::uint32_t>(
      std::bit_ceil(std::clamp(pixels, std::size_t{1} << 14, std::size_t{1} << 24)));
}

// Returns how many invocations share a list of cells or pixels of a frame of so many pixels: whole
// groups of them. Such lists are much shorter than the picture. A driver that runs shaders on a CPU
// works through all of one even where a group has nothing to do, so there are fewer of them than
// entries: still enough groups to cut into slices. Other devices mostly have one for each entry, up
// to what fills the largest twice.
std::uint32_t count_takers(std::size_t pixels, bool is_cpu) {
  const std::size_t wanted = is_cpu ? std::min(pixels / 64, std::size_t{1} << 13)
                                    : std::min(pixels / 4, std::size_t{1} << 19);
  return static_cast<std::uint32_t>((wanted / WORKGROUP_ROW + 1) * WORKGROUP_ROW);
}

// Returns the angle of a pixel in the middle of the picture, rad.
float pixel_angle(const gpu::Frame& frame) {
  constexpr auto half_turn = std::numbers::pi_v<float>;
  switch (frame.camera.projection) {
    case PROJECTION_EQUIRECTANGULAR:
      return half_turn / float(frame.size.y);
    case PROJECTION_FISHEYE:
      return half_turn / float(std::min(frame.size.x, frame.size.y));
    default:
      return 2 * frame.camera.tan_half_height / float(frame.size.y);
  }
}

}  // namespace

void IrradianceCache::enter(gpu::Frame& frame, const IndirectSettings& settings, double moved_s,
                            std::uint32_t max_paths) {
  width_ = frame.size.x;
  height_ = frame.size.y;
  const std::size_t pixels = std::size_t{width_} * height_;
  if (count_ < cells_for(pixels)) {
    count_ = cells_for(pixels);
    cells_ = gpu::Buffer(device_, count_ * sizeof(gpu::IrradianceCell));
    forget_ = true;
  }
  const std::size_t seen_bytes = (1 + pixels) * sizeof(std::uint32_t);
  for (gpu::Buffer* list : {&seen_, &uncached_})
    if (list->bytes() < seen_bytes) *list = gpu::Buffer(device_, seen_bytes);
  forget_ = forget_ || moved_s >= memory_s;
  if (forget_) cells_.fill_zero();
  // New cells come in numbers when nothing is known or the camera moves.
  const bool many_new = forget_ || frame.camera.position != frame.previous_camera.position ||
                        frame.camera.forward != frame.previous_camera.forward;
  rounds_ = std::min((many_new ? NEW_CELL_FACTOR : 1) * settings.paths, max_paths);
  forget_ = false;
  frame.cells = cells_.address();
  frame.seen_cells = seen_.address();
  frame.uncached = uncached_.address();
  frame.cell_mask = count_ - 1;
  frame.cell_paths = settings.paths;
  frame.cell_angle = settings.cell_px * pixel_angle(frame);
  const double frames = moved_s > 0 ? std::ceil(memory_s / moved_s) : max_samples;
  frame.max_cell_samples =
      static_cast<float>(std::min(frames * settings.paths, double(max_samples)));
  frame.cell_memory = static_cast<std::uint32_t>(std::min(frames, double(max_samples)));
}

std::vector<FrameStep> IrradianceCache::list_steps(const PassSet& passes,
                                                   std::uint64_t frame_address) const {
  const gpu::Push all{frame_address, 0, count_};
  std::vector<FrameStep> steps;
  steps.push_back({"cache cells", 1, [this, &passes, all](VkCommandBuffer commands, auto, auto) {
                     passes.cache_evict.dispatch(commands, &all, count_);
                     gpu::full_barrier(commands);
                     passes.cache_mark.dispatch(commands, &all, width_, height_);
                   }});
  for (std::uint32_t round = 0; round <= rounds_; ++round)
    steps.push_back(list_step("cache paths", passes, frame_address, round));
  return steps;
}

FrameStep IrradianceCache::path_step(const PassSet& passes, std::uint64_t frame_address) const {
  return list_step("uncached paths", passes, frame_address, UNCACHED_ROUND);
}

FrameStep IrradianceCache::list_step(const char* name, const PassSet& passes,
                                     std::uint64_t frame_address, std::uint32_t round) const {
  const TracePass& pass = passes.cache_update;
  const std::uint32_t takers =
      count_takers(std::size_t{width_} * height_, device_.info().kind == "cpu");
  return {name, pass.count_groups(takers, 1),
          [&pass, takers, push = gpu::Push{frame_address, round, takers}](
              VkCommandBuffer commands, std::uint32_t part, std::uint32_t parts) {
            pass.dispatch_groups(commands, &push, takers, 1, part, parts);
          }};
}

}  // namespace nightcity::render
