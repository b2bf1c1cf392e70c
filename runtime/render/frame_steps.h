// The list of the passes that make a frame, with the grids of invocations that they run over.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "runtime/render/frame_run.h"
#include "runtime/render/irradiance_cache.h"
#include "runtime/render/pass_library.h"
#include "runtime/render/settings.h"
#include "runtime/render/vehicle_passes.h"

namespace nightcity::render {

/// The steps of a frame work with these. Passes, cache and vehicles must outlive the steps.
struct FrameParts {
  const PassSet& passes;
  const IrradianceCache& cache;
  const VehiclePasses& vehicles;
  std::uint64_t frame_address;  // of the gpu::Frame
  glm::uvec2 size;
  bool has_history;
  std::uint32_t lights;  // of the scene, vehicles' included
  std::uint32_t slices;  // from choose_reference_slices
  // Steps copy from the first to the second, and from the third to the fourth.
  VkBuffer reservoirs, spatial, radiance, denoised;
};

/// Returns the steps of a frame for these settings, which are within their ranges.
std::vector<FrameStep> list_steps(const FrameParts& frame, const RenderSettings& settings);

/// Returns how many slices the reference works at side by side: a picture of few pixels leaves most
/// of a GPU idle, so chunks of lights share it. A driver on a CPU is soon busy, and a part of a step
/// then stays short enough for a window. Layers exist once, so they allow one slice.
std::uint32_t choose_reference_slices(const RenderSettings& settings, glm::uvec2 size,
                                      std::uint32_t lights, bool is_cpu);

/// Returns the number of paths that the reference follows from a pixel in a frame:
/// shaders/limits.h.
std::uint32_t reference_paths(std::uint32_t lights);

}  // namespace nightcity::render
