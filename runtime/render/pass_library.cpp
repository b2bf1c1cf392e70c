#include "runtime/render/pass_library.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <span>
#include <utility>

#include "runtime/gpu/submission.h"
#include "runtime/render/compile_passes.h"
#include "spirv/passes.h"

namespace nightcity::render {
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
  const auto& [constants, extent] = key;
  PassSet set = compile_passes(device_, constants, extent, draft.get());
  if (extent == Extent::draft) translate(set, constants);
  spdlog::debug("the passes of {} are compiled", extent == Extent::whole ? "frames" : "a draft");
  return set;
}

const TracePass& PassLibrary::upward(const PassConstants& constants) {
  const auto known = upward_.find(constants);
  if (known != upward_.end()) return known->second;
  return upward_
      .emplace(constants, compile_trace(device_, constants,
                                        {upward_spirv, upward_query_spirv, upward_pipeline_spirv},
                                        over_a_list))
      .first->second;
}

const TracePass& PassLibrary::rays(const PassConstants& constants, bool any_hit) {
  const auto known = rays_.find({constants, any_hit});
  if (known != rays_.end()) return known->second;
  const TraceShader shader =
      any_hit ? TraceShader{rays_any_spirv, rays_any_query_spirv, rays_any_pipeline_spirv}
              : TraceShader{rays_spirv, rays_query_spirv, rays_pipeline_spirv};
  return rays_
      .emplace(std::pair(constants, any_hit),
               compile_trace(device_, constants, shader, over_a_list))
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

}  // namespace nightcity::render
