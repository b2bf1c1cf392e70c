#include "runtime/render/pass_library.h"

#include <span>

#include "spirv/accumulate.h"
#include "spirv/candidates.h"
#include "spirv/primary.h"
#include "spirv/reference.h"
#include "spirv/shade.h"
#include "spirv/spatial.h"
#include "spirv/temporal.h"

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

}  // namespace nightcity
