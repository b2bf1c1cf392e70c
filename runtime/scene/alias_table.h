// Sampling an index with given weights in constant time.
#pragma once

#include <span>
#include <vector>

#include "shaders/interface.h"

namespace nightcity::scene {

/// Returns an alias table (Walker 1977; construction after Vose 1991) over non-negative weights,
/// summed in double. Zero weights get pdf 0; if all are zero, the table is uniform. Non-finite and
/// negative weights count as zero.
std::vector<gpu::AliasEntry> build_alias_table(std::span<const float> weights);

}  // namespace nightcity::scene
