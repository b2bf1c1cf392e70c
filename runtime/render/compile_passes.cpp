#include "runtime/render/compile_passes.h"

#include <functional>
#include <utility>
#include <vector>

#include "formats/parallel.h"
#include "spirv/passes.h"

namespace nightcity::render {
namespace {

// Lists the passes that some constants need as jobs, and runs them on all cores.
class PassCompiler {
 public:
  PassCompiler(gpu::Device& device, const PassConstants& constants, const PassSet* draft)
      : device_(device), constants_(constants), draft_(draft) {}

  PassSet compile(Extent extent) {
    const bool whole = extent == Extent::whole;
    const bool is_reference = constants_[CONSTANT_ESTIMATOR] == ESTIMATOR_REFERENCE;
    // The largest come first, and of these the paths of the irradiance cache, which take longest by
    // far.
    if (constants_[CONSTANT_INDIRECT] == INDIRECT_CACHE) add_cache();
    if (is_reference)
      add_reference();
    else
      add_candidates();
    if (whole && !is_reference) add_reuse();
    add_shared(set_.primary, draft_ ? &draft_->primary : nullptr,
               {primary_spirv, primary_query_spirv, primary_pipeline_spirv});
    if (constants_[CONSTANT_TRAFFIC] != 0) add_vehicles();
    add(set_.accumulate, accumulate_spirv, over_pixels);
    if (whole) {
      add(set_.inspect, inspect_spirv, over_pixels);
      add(set_.demodulate, demodulate_spirv, over_pixels);
      add(set_.denoise, denoise_spirv, over_pixels);
    }
    run_parallel(jobs_.size(), count_cores(), [&](std::size_t i) { jobs_[i](); });
    return std::move(set_);
  }

 private:
  void add_cache() {
    add_trace(set_.cache_update,
              {cache_update_spirv, cache_update_query_spirv, cache_update_pipeline_spirv},
              over_a_list);
    add(set_.cache_evict, cache_evict_spirv, over_a_list);
    add(set_.cache_mark, cache_mark_spirv, over_pixels);
  }

  void add_reference() {
    add_trace(set_.reference, {reference_spirv, reference_query_spirv, reference_pipeline_spirv});
    if (constants_[CONSTANT_INDIRECT] != INDIRECT_NONE)
      add_trace(set_.reference_path,
                {reference_path_spirv, reference_path_query_spirv, reference_path_pipeline_spirv});
    if (constants_[CONSTANT_AIR] != 0)
      add_trace(set_.reference_air,
                {reference_air_spirv, reference_air_query_spirv, reference_air_pipeline_spirv});
  }

  // Adds what every estimator with reservoirs needs, drafts included.
  void add_candidates() {
    add_shared(set_.candidates, draft_ ? &draft_->candidates : nullptr,
               {candidates_spirv, candidates_query_spirv, candidates_pipeline_spirv});
    if (constants_[CONSTANT_INDIRECT] == INDIRECT_PATHS)
      add_trace(set_.shade,
                {shade_paths_spirv, shade_paths_query_spirv, shade_paths_pipeline_spirv});
    else
      add_trace(set_.shade, {shade_spirv, shade_query_spirv, shade_pipeline_spirv});
  }

  // Adds what reuses reservoirs, fills in pixels and looks through air.
  void add_reuse() {
    add_trace(set_.temporal, {temporal_spirv, temporal_query_spirv, temporal_pipeline_spirv});
    if (gpu::reuse_weights(constants_[CONSTANT_ESTIMATOR]) == WEIGHTS_PAIRWISE) {
      add_trace(set_.pair_targets,
                {pair_targets_spirv, pair_targets_query_spirv, pair_targets_pipeline_spirv});
      add(set_.pair_reuse, pair_reuse_spirv, over_pixels);
    } else {
      add_trace(set_.spatial, {spatial_spirv, spatial_query_spirv, spatial_pipeline_spirv});
    }
    add(set_.fill, fill_spirv, over_pixels);
    if (constants_[CONSTANT_AIR] != 0)
      add_trace(set_.air, {air_spirv, air_query_spirv, air_pipeline_spirv});
  }

  void add_vehicles() {
    add(set_.vehicle_pose, vehicle_pose_spirv, over_a_list);
    add(set_.vehicle_offsets, vehicle_offsets_spirv, over_a_list);
    add(set_.vehicle_order, vehicle_order_spirv, over_a_list);
    add(set_.vehicle_sort_cells, vehicle_sort_cells_spirv, over_a_list);
    add(set_.vehicle_bvh, vehicle_bvh_spirv, over_a_list);
  }

  void add(gpu::ComputePass& pass, std::span<const std::uint32_t> spirv, gpu::Workgroup workgroup) {
    jobs_.push_back([this, &pass, spirv, workgroup] {
      pass = gpu::ComputePass(device_, spirv, constants_, sizeof(gpu::Push), workgroup);
    });
  }

  void add_trace(TracePass& pass, const TraceShader& shader,
                 gpu::Workgroup workgroup = over_pixels) {
    jobs_.push_back([this, &pass, shader, workgroup] {
      pass = compile_trace(device_, constants_, shader, workgroup);
    });
  }

  // Adds a pass that is shared with a draft, and compiled where there is no draft.
  void add_shared(std::shared_ptr<const TracePass>& pass,
                  const std::shared_ptr<const TracePass>* of_draft, const TraceShader& shader) {
    if (of_draft) {
      pass = *of_draft;
      return;
    }
    jobs_.push_back([this, &pass, shader] {
      pass = std::make_shared<const TracePass>(
          compile_trace(device_, constants_, shader, over_pixels));
    });
  }

  gpu::Device& device_;
  const PassConstants& constants_;
  const PassSet* draft_;
  PassSet set_;
  std::vector<std::function<void()>> jobs_;
};

}  // namespace

TracePass compile_trace(gpu::Device& device, const PassConstants& constants,
                        const TraceShader& shader, gpu::Workgroup workgroup) {
  const gpu::Trace trace = device.trace();
  if (trace == gpu::Trace::pipeline)
    return TracePass(gpu::RayPass(device, {shader.pipeline, trace_miss_spirv, trace_hit_spirv},
                                  constants, sizeof(gpu::Push)));
  const auto words = trace == gpu::Trace::query ? shader.query : shader.compute;
  return TracePass(gpu::ComputePass(device, words, constants, sizeof(gpu::Push), workgroup));
}

PassSet compile_passes(gpu::Device& device, const PassConstants& constants, Extent extent,
                       const PassSet* draft) {
  return PassCompiler(device, constants, draft).compile(extent);
}

}  // namespace nightcity::render
