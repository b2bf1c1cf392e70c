#include "runtime/render/frame_steps.h"

#include <algorithm>

#include "runtime/render/pass_constants.h"
#include "runtime/render/setting_table.h"

namespace nightcity::render {
namespace {

// Invocations that fill the largest devices twice, those that a driver on a CPU needs by far, and
// the most slices that the reference works at together. A part of a step is a work group of all
// slices: with 32 of them and many lights, a CPU takes longer for it than a window may wait.
constexpr std::size_t busy_invocations = std::size_t{1} << 19, busy_on_cpu = std::size_t{1} << 11;
constexpr std::size_t max_slices = 32;

constexpr std::uint32_t chunks_of(std::uint32_t lights) {
  return lights / REFERENCE_CHUNK + (lights % REFERENCE_CHUNK != 0);
}

// Returns a step with one invocation per cell of a grid and slice.
template <class Pass>
FrameStep step_over(const FrameParts& frame, glm::uvec2 grid, const Pass& pass, const char* name,
                    std::uint32_t first = 0, std::uint32_t count = 0, std::uint32_t slices = 1) {
  const gpu::Push push{frame.frame_address, first, count};
  return {name, pass.count_groups(grid.x, grid.y),
          [&pass, push, grid, slices](VkCommandBuffer commands, std::uint32_t part,
                                      std::uint32_t parts) {
            pass.dispatch_groups(commands, &push, grid.x, grid.y, part, parts, slices);
          }};
}

// Returns a step with one invocation per pixel and slice.
template <class Pass>
FrameStep step_of(const FrameParts& frame, const Pass& pass, const char* name,
                  std::uint32_t first = 0, std::uint32_t count = 0, std::uint32_t slices = 1) {
  return step_over(frame, frame.size, pass, name, first, count, slices);
}

// Returns a step that copies what a buffer holds of every pixel.
FrameStep copy_of(const FrameParts& frame, const char* name, VkBuffer from, VkBuffer to,
                  std::size_t pixel_bytes) {
  const VkBufferCopy all{0, 0, std::size_t{frame.size.x} * frame.size.y * pixel_bytes};
  return {name, 1, [=](VkCommandBuffer commands, auto, auto) {
            vkCmdCopyBuffer(commands, from, to, 1, &all);
          }};
}

void add_restir(std::vector<FrameStep>& steps, const FrameParts& frame,
                const RenderSettings& settings) {
  // At half rate the pixels of a frame lie side by side in the left half of the grid, those that
  // may have to be filled in the right half: half_rate.glsl.
  const bool half_rate = is_half_rate(settings);
  const glm::uvec2 half{(frame.size.x + 1) / 2, frame.size.y},
      sampled = half_rate ? half : frame.size,
      any{half_rate ? 2 * half.x : frame.size.x, frame.size.y};
  steps.push_back(step_over(frame, any, *frame.passes.candidates, "candidates"));
  const EstimatorTraits& traits = traits_of(settings.sampling.estimator);
  if (traits.reuses && settings.reuse.max_history > 0 && frame.has_history)
    steps.push_back(step_over(frame, sampled, frame.passes.temporal, "temporal"));
  if (traits.reuses && settings.reuse.neighbours > 0) {
    if (traits.pairs) {
      steps.push_back(step_over(frame, sampled, frame.passes.pair_targets, "spatial targets"));
      steps.push_back(step_over(frame, sampled, frame.passes.pair_reuse, "spatial"));
    } else {
      steps.push_back(step_over(frame, sampled, frame.passes.spatial, "spatial"));
    }
  } else {
    steps.push_back(
        copy_of(frame, "copy", frame.reservoirs, frame.spatial, sizeof(gpu::Reservoir)));
  }
  if (find_indirect(settings) == INDIRECT_CACHE)
    for (FrameStep& step : frame.cache.list_steps(frame.passes, frame.frame_address))
      steps.push_back(std::move(step));
  steps.push_back(step_over(frame, any, frame.passes.shade, "shade"));
  if (find_indirect(settings) == INDIRECT_CACHE)
    steps.push_back(frame.cache.path_step(frame.passes, frame.frame_address));
  if (half_rate) steps.push_back(step_over(frame, half, frame.passes.fill, "fill"));
  if (has_air(settings)) steps.push_back(step_of(frame, frame.passes.air, "air"));
}

void add_reference(std::vector<FrameStep>& steps, const FrameParts& frame,
                   const RenderSettings& settings) {
  const std::uint32_t lights = frame.lights;
  const std::uint32_t lights_per_dispatch = REFERENCE_CHUNK * frame.slices;
  std::uint32_t first = 0;
  do {  // without lights, one empty chunk writes the light that surfaces emit
    const std::uint32_t count = std::min(lights_per_dispatch, lights - first);
    steps.push_back(step_of(frame, frame.passes.reference, "reference", first, count,
                            std::max(chunks_of(count), 1u)));
    if (has_air(settings))
      for (std::uint32_t part = 0; part < std::min(count, REFERENCE_CHUNK); part += AIR_CHUNK)
        steps.push_back(step_of(frame, frame.passes.reference_air, "reference air", first + part,
                                first + count, chunks_of(count)));
    first += lights_per_dispatch;
  } while (first < lights);
  if (settings.indirect.bounces == 0) return;
  for (std::uint32_t path = 0; path < reference_paths(lights); ++path)
    for (std::uint32_t bounce = 1; bounce <= settings.indirect.bounces; ++bounce)
      steps.push_back(step_of(frame, frame.passes.reference_path, "reference paths", path, bounce));
}

void add_end(std::vector<FrameStep>& steps, const FrameParts& frame,
             const RenderSettings& settings) {
  steps.push_back(step_of(frame, frame.passes.accumulate, "accumulate"));
  if (!settings.display.denoise) return;
  steps.push_back(step_of(frame, frame.passes.demodulate, "demodulate"));
  for (std::uint32_t level = 0; level < DENOISE_LEVELS; ++level)
    steps.push_back(step_of(frame, frame.passes.denoise, "denoise", level));
  // The next frame writes `radiance` before it is complete.
  steps.push_back(
      copy_of(frame, "denoise", frame.radiance, frame.denoised, sizeof(gpu::Accumulation)));
}

}  // namespace

std::uint32_t reference_paths(std::uint32_t lights) {
  return lights <= REFERENCE_CHUNK ? REFERENCE_PATHS : REFERENCE_PICK_PATHS;
}

std::uint32_t choose_reference_slices(const RenderSettings& settings, glm::uvec2 size,
                                      std::uint32_t lights, bool is_cpu) {
  if (traits_of(settings.sampling.estimator).samples || settings.sampling.layers) return 1;
  const std::size_t pixels = std::size_t{size.x} * size.y;
  const std::size_t chunks = chunks_of(lights);
  return static_cast<std::uint32_t>(
      std::clamp(std::min((is_cpu ? busy_on_cpu : busy_invocations) / pixels, chunks),
                 std::size_t{1}, max_slices));
}

std::vector<FrameStep> list_steps(const FrameParts& frame, const RenderSettings& settings) {
  std::vector<FrameStep> steps = frame.vehicles.list_steps(frame.passes, frame.frame_address);
  steps.push_back(step_of(frame, *frame.passes.primary, "primary"));
  if (traits_of(settings.sampling.estimator).samples)
    add_restir(steps, frame, settings);
  else
    add_reference(steps, frame, settings);
  add_end(steps, frame, settings);
  return steps;
}

}  // namespace nightcity::render
