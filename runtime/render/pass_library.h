// The compiled passes, by specialization constants. A driver takes up to a second to compile them,
// so renderers of one device share them, and switching back to an estimator costs nothing.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <future>
#include <map>
#include <memory>
#include <span>

#include "runtime/gpu/compute_pass.h"
#include "runtime/gpu/device.h"
#include "runtime/render/trace_pass.h"
#include "shaders/interface.h"

namespace nightcity::render {

using PassConstants = std::array<std::uint32_t, CONSTANT_COUNT>;

struct PassSet {
  gpu::ComputePass accumulate, demodulate, denoise, inspect;
  // Compiled only with traffic.
  gpu::ComputePass vehicle_pose, vehicle_offsets, vehicle_order, vehicle_sort_cells, vehicle_bvh;
  TracePass primary;
  TracePass reference, reference_path;    // compiled only for the reference estimator
  TracePass candidates, temporal, shade;  // compiled only for the others
  TracePass spatial;                      // compiled only for weights not pairwise
  gpu::ComputePass fill;                  // compiled with them
  TracePass pair_targets;                 // compiled only for pairwise weights
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

class PassLibrary {
 public:
  /// The device must outlive the library. `kept`: so many sets of passes, those that were asked for
  /// last, stay compiled although nobody holds them: on a CPU driver each takes some 70 MB, and as
  /// many are needed by turns where settings are compared.
  explicit PassLibrary(gpu::Device& device, std::size_t kept = SIZE_MAX)
      : device_(device), kept_(kept) {}

  /// Returns the passes for these constants, compiled where they are not kept. Who uses the result
  /// on the device holds it until the device is done.
  std::shared_ptr<const PassSet> get(const PassConstants& constants);
  /// Returns whether these passes are compiled. If not, starts to compile them in the background,
  /// one set at a time.
  bool is_ready(const PassConstants& constants);
  const TracePass& upward(const PassConstants& constants);
  /// The same for the passes of the display. Only the display's constants may differ from 0.
  const DisplayPasses& display(const PassConstants& constants);

 private:
  // The SPIR-V of one pass for each tracing backend.
  struct TraceShader {
    std::span<const std::uint32_t> compute, query, pipeline;
  };
  struct Kept {
    std::shared_ptr<const PassSet> set;
    std::uint64_t asked = 0;  // when, in calls
  };
  // Returns the set that is kept for these constants, null without one.
  std::shared_ptr<const PassSet> find(const PassConstants& constants);
  std::shared_ptr<const PassSet> keep(const PassConstants& constants, PassSet set);
  PassSet make_set(const PassConstants& constants);
  TracePass make_trace(const PassConstants& constants, const TraceShader& shader,
                       gpu::Workgroup workgroup);

  gpu::Device& device_;
  std::size_t kept_;
  std::map<PassConstants, Kept> sets_;
  std::uint64_t asked_ = 0;  // calls
  std::map<PassConstants, TracePass> upward_;
  std::map<PassConstants, DisplayPasses> display_;
  PassConstants next_{};      // compiled in the background,
  std::future<PassSet> set_;  // if this is valid; it uses the device, so it is destroyed first
};

}  // namespace nightcity::render
