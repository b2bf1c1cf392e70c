// The compiled passes of a frame and of the display, and the constants that they are compiled for.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "runtime/gpu/compute_pass.h"
#include "runtime/render/trace_pass.h"
#include "shaders/interface.h"

namespace nightcity::render {

using PassConstants = std::array<std::uint32_t, CONSTANT_COUNT>;

struct PassSet {
  gpu::ComputePass accumulate, demodulate, denoise, inspect;
  // Compiled only with traffic.
  gpu::ComputePass vehicle_pose, vehicle_offsets, vehicle_order, vehicle_sort_cells, vehicle_bvh;
  // Shared with the set of a draft: they are the same whether or not light bounces.
  std::shared_ptr<const TracePass> primary, candidates;
  TracePass reference, reference_path;  // compiled only for the reference estimator
  TracePass temporal, shade;            // compiled only for the others, as candidates are
  TracePass spatial;                    // compiled only for weights not pairwise
  gpu::ComputePass fill;                // compiled with them
  TracePass pair_targets;               // compiled only for pairwise weights
  gpu::ComputePass pair_reuse;
  gpu::ComputePass cache_evict, cache_mark;  // compiled only with the irradiance cache
  TracePass cache_update;
  TracePass air, reference_air;  // compiled only with air
};

// The passes of display.h.
struct DisplayPasses {
  gpu::ComputePass expose;
  gpu::ComputePass glare_down, glare_up;  // compiled only with glare
};

/// Passes are compiled for any frame, or for drafts alone (Effort::draft), which takes a third of
/// the time.
enum class Extent : std::uint8_t { whole, draft };

}  // namespace nightcity::render
