#include "runtime/render/pass_library.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "formats/parallel.h"
#include "runtime/gpu/submission.h"
#include "spirv/passes.h"

namespace nightcity::render {
namespace {

constexpr gpu::Workgroup over_pixels{WORKGROUP_SIZE, WORKGROUP_SIZE};
constexpr gpu::Workgroup over_a_list{WORKGROUP_ROW, 1};

}  // namespace

std::shared_ptr<const PassSet> PassLibrary::find(const Key& key) {
  const auto known = sets_.find(key);
  if (known == sets_.end()) return nullptr;
  known->second.asked = ++asked_;
  return known->second.set;
}

std::shared_ptr<const PassSet> PassLibrary::keep(const Key& key, PassSet set) {
  const auto shared = std::make_shared<const PassSet>(std::move(set));
  sets_[key] = {shared, ++asked_};
  while (sets_.size() > std::max(kept_, std::size_t{1}))
    sets_.erase(std::min_element(
        sets_.begin(), sets_.end(),
        [](const auto& one, const auto& other) { return one.second.asked < other.second.asked; }));
  return shared;
}

std::shared_ptr<const PassSet> PassLibrary::get(const PassConstants& constants, Extent extent) {
  const std::lock_guard lock(mutex_);
  const Key key{constants, extent};
  if (auto known = find(key)) return known;
  return keep(key, set_.valid() && next_ == key ? set_.get() : make_set(key, find_draft(key)));
}

void PassLibrary::collect() {
  if (set_.valid() && set_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    keep(next_, set_.get());
}

bool PassLibrary::has(const PassConstants& constants) {
  const std::lock_guard lock(mutex_);
  collect();
  return find({constants, Extent::whole}) != nullptr;
}

bool PassLibrary::is_ready(const PassConstants& constants, Extent extent) {
  const std::lock_guard lock(mutex_);
  const Key key{constants, extent};
  if (find(key)) return true;
  collect();
  if (find(key)) return true;
  if (!set_.valid()) {
    next_ = key;
    set_ = std::async(std::launch::async,
                      [this, key, draft = find_draft(key)] { return make_set(key, draft); });
  }
  return false;
}

// Mesa's CPU driver translates a pass to machine code when it runs for the first time. No work
// groups are enough. Each pass is a submission of its own, since others wait for it.
void PassLibrary::translate(const PassSet& set, const PassConstants& constants) {
  if (device_.info().kind != "cpu") return;
  gpu::Submission submission(device_);
  const auto run = [&](const auto& pass) {
    const gpu::Push push{};
    is_busy_ = true;
    pass.dispatch(submission.begin(), &push, 0, 0, 0);
    submission.submit();
    submission.wait(std::numeric_limits<double>::infinity());
    is_busy_ = false;
  };
  if (constants[CONSTANT_TRAFFIC] != 0)
    for (const gpu::ComputePass* pass :
         {&set.vehicle_pose, &set.vehicle_offsets, &set.vehicle_order, &set.vehicle_sort_cells,
          &set.vehicle_bvh})
      run(*pass);
  for (const TracePass* pass : {set.primary.get(), set.candidates.get(), &set.shade}) run(*pass);
  run(set.accumulate);
}

std::shared_ptr<const PassSet> PassLibrary::find_draft(const Key& key) {
  Key draft{key.first, Extent::draft};
  draft.first[CONSTANT_INDIRECT] = INDIRECT_NONE;
  const auto known = sets_.find(draft);
  return known == sets_.end() ? nullptr : known->second.set;
}

PassSet PassLibrary::make_set(const Key& key, const std::shared_ptr<const PassSet>& draft) {
  const PassConstants& constants = key.first;
  const bool whole = key.second == Extent::whole;
  const auto make = [&](std::span<const std::uint32_t> spirv, gpu::Workgroup workgroup) {
    return gpu::ComputePass(device_, spirv, constants, sizeof(gpu::Push), workgroup);
  };
  const auto make_trace = [&](const TraceShader& shader) {
    return this->make_trace(constants, shader, over_pixels);
  };
  const auto share = [&](const TraceShader& shader) {
    return std::make_shared<const TracePass>(make_trace(shader));
  };
  // Passes are compiled on all cores, the largest first.
  PassSet set;
  std::vector<std::function<void()>> jobs;
  // The paths of the irradiance cache take longest by far, so they begin first.
  if (constants[CONSTANT_INDIRECT] == INDIRECT_CACHE) {
    jobs.push_back([&] {
      set.cache_update = this->make_trace(
          constants, {cache_update_spirv, cache_update_query_spirv, cache_update_pipeline_spirv},
          over_a_list);
    });
    jobs.push_back([&] { set.cache_evict = make(cache_evict_spirv, over_a_list); });
    jobs.push_back([&] { set.cache_mark = make(cache_mark_spirv, over_pixels); });
  }
  if (constants[CONSTANT_ESTIMATOR] == ESTIMATOR_REFERENCE) {
    jobs.push_back([&] {
      set.reference =
          make_trace({reference_spirv, reference_query_spirv, reference_pipeline_spirv});
    });
    if (constants[CONSTANT_INDIRECT] != INDIRECT_NONE)
      jobs.push_back([&] {
        set.reference_path = make_trace(
            {reference_path_spirv, reference_path_query_spirv, reference_path_pipeline_spirv});
      });
    if (constants[CONSTANT_AIR] != 0)
      jobs.push_back([&] {
        set.reference_air = make_trace(
            {reference_air_spirv, reference_air_query_spirv, reference_air_pipeline_spirv});
      });
  } else {
    jobs.push_back([&] {
      set.candidates =
          draft ? draft->candidates
                : share({candidates_spirv, candidates_query_spirv, candidates_pipeline_spirv});
    });
    jobs.push_back([&] {
      set.shade =
          constants[CONSTANT_INDIRECT] == INDIRECT_PATHS
              ? make_trace({shade_paths_spirv, shade_paths_query_spirv, shade_paths_pipeline_spirv})
              : make_trace({shade_spirv, shade_query_spirv, shade_pipeline_spirv});
    });
  }
  if (whole && constants[CONSTANT_ESTIMATOR] != ESTIMATOR_REFERENCE) {
    jobs.push_back([&] {
      set.temporal = make_trace({temporal_spirv, temporal_query_spirv, temporal_pipeline_spirv});
    });
    if (gpu::reuse_weights(constants[CONSTANT_ESTIMATOR]) == WEIGHTS_PAIRWISE) {
      jobs.push_back([&] {
        set.pair_targets =
            make_trace({pair_targets_spirv, pair_targets_query_spirv, pair_targets_pipeline_spirv});
      });
      jobs.push_back([&] { set.pair_reuse = make(pair_reuse_spirv, over_pixels); });
    } else {
      jobs.push_back([&] {
        set.spatial = make_trace({spatial_spirv, spatial_query_spirv, spatial_pipeline_spirv});
      });
    }
    jobs.push_back([&] { set.fill = make(fill_spirv, over_pixels); });
    if (constants[CONSTANT_AIR] != 0)
      jobs.push_back([&] {
        set.air = make_trace({air_spirv, air_query_spirv, air_pipeline_spirv});
      });
  }
  jobs.push_back([&] {
    set.primary = draft ? draft->primary
                        : share({primary_spirv, primary_query_spirv, primary_pipeline_spirv});
  });
  if (constants[CONSTANT_TRAFFIC] != 0) {
    jobs.push_back([&] { set.vehicle_pose = make(vehicle_pose_spirv, over_a_list); });
    jobs.push_back([&] { set.vehicle_offsets = make(vehicle_offsets_spirv, over_a_list); });
    jobs.push_back([&] { set.vehicle_order = make(vehicle_order_spirv, over_a_list); });
    jobs.push_back([&] { set.vehicle_sort_cells = make(vehicle_sort_cells_spirv, over_a_list); });
    jobs.push_back([&] { set.vehicle_bvh = make(vehicle_bvh_spirv, over_a_list); });
  }
  jobs.push_back([&] { set.accumulate = make(accumulate_spirv, over_pixels); });
  if (whole) {
    jobs.push_back([&] { set.inspect = make(inspect_spirv, over_pixels); });
    jobs.push_back([&] { set.demodulate = make(demodulate_spirv, over_pixels); });
    jobs.push_back([&] { set.denoise = make(denoise_spirv, over_pixels); });
  }
  run_parallel(jobs.size(), count_cores(), [&](std::size_t i) { jobs[i](); });
  if (!whole) translate(set, constants);
  spdlog::debug("the passes of {} are compiled", whole ? "frames" : "a draft");
  return set;
}

const TracePass& PassLibrary::upward(const PassConstants& constants) {
  const auto known = upward_.find(constants);
  if (known != upward_.end()) return known->second;
  return upward_
      .emplace(constants,
               make_trace(constants, {upward_spirv, upward_query_spirv, upward_pipeline_spirv},
                          over_a_list))
      .first->second;
}

const TracePass& PassLibrary::rays(const PassConstants& constants, bool any_hit) {
  const auto known = rays_.find({constants, any_hit});
  if (known != rays_.end()) return known->second;
  const TraceShader shader =
      any_hit ? TraceShader{rays_any_spirv, rays_any_query_spirv, rays_any_pipeline_spirv}
              : TraceShader{rays_spirv, rays_query_spirv, rays_pipeline_spirv};
  return rays_.emplace(std::pair(constants, any_hit), make_trace(constants, shader, over_a_list))
      .first->second;
}

const DisplayPasses& PassLibrary::display(const PassConstants& constants) {
  const auto known = display_.find(constants);
  if (known != display_.end()) return known->second;
  const auto make = [&](std::span<const std::uint32_t> spirv) {
    return gpu::ComputePass(device_, spirv, constants, sizeof(gpu::Push), over_pixels);
  };
  DisplayPasses passes;
  passes.expose = make(expose_spirv);
  if (constants[CONSTANT_GLARE] != 0) {
    passes.glare_down = make(glare_down_spirv);
    passes.glare_up = make(glare_up_spirv);
  }
  return display_.emplace(constants, std::move(passes)).first->second;
}

TracePass PassLibrary::make_trace(const PassConstants& constants, const TraceShader& shader,
                                  gpu::Workgroup workgroup) {
  const gpu::Trace trace = device_.trace();
  if (trace == gpu::Trace::pipeline)
    return TracePass(gpu::RayPass(device_, {shader.pipeline, trace_miss_spirv, trace_hit_spirv},
                                  constants, sizeof(gpu::Push)));
  const auto words = trace == gpu::Trace::query ? shader.query : shader.compute;
  return TracePass(gpu::ComputePass(device_, words, constants, sizeof(gpu::Push), workgroup));
}

}  // namespace nightcity::render
