#include "runtime/render/pass_library.h"

#include <span>

#include "spirv/accumulate.h"
#include "spirv/candidates.h"
#include "spirv/demodulate.h"
#include "spirv/denoise.h"
#include "spirv/fleet_offsets.h"
#include "spirv/fleet_order.h"
#include "spirv/fleet_pose.h"
#include "spirv/fleet_settle.h"
#include "spirv/fleet_tree.h"
#include "spirv/primary.h"
#include "spirv/reference.h"
#include "spirv/shade.h"
#include "spirv/spatial.h"
#include "spirv/temporal.h"
#include "spirv/upward.h"

namespace nightcity {

const PassSet& PassLibrary::get(const PassConstants& constants) {
  const auto known = sets_.find(constants);
  if (known != sets_.end()) return known->second;
  const auto make = [&](std::span<const std::uint32_t> spirv) {
    return gpu::ComputePass(device_, spirv, constants, sizeof(gpu::Push));
  };
  PassSet set;
  set.primary = make(primary_spirv);
  set.accumulate = make(accumulate_spirv);
  set.demodulate = make(demodulate_spirv);
  set.denoise = make(denoise_spirv);
  if (constants[CONSTANT_TRAFFIC] != 0) {
    set.fleet_pose = make(fleet_pose_spirv);
    set.fleet_offsets = make(fleet_offsets_spirv);
    set.fleet_order = make(fleet_order_spirv);
    set.fleet_settle = make(fleet_settle_spirv);
    set.fleet_tree = make(fleet_tree_spirv);
  }
  if (constants[CONSTANT_ESTIMATOR] == ESTIMATOR_REFERENCE) {
    set.reference = make(reference_spirv);
  } else {
    set.candidates = make(candidates_spirv);
    set.temporal = make(temporal_spirv);
    set.spatial = make(spatial_spirv);
    set.shade = make(shade_spirv);
  }
  return sets_.emplace(constants, std::move(set)).first->second;
}

const gpu::ComputePass& PassLibrary::upward(const PassConstants& constants) {
  const auto known = upward_.find(constants);
  if (known != upward_.end()) return known->second;
  return upward_.try_emplace(constants, device_, upward_spirv, constants, std::uint32_t{sizeof(gpu::Push)})
      .first->second;
}

}  // namespace nightcity
