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

/// Builds many such tables, one after the other, in the same memory.
class AliasTableBuilder {
 public:
  /// Returns the table as build_alias_table does. It is valid until the next call.
  std::span<const gpu::AliasEntry> build(std::span<const float> weights);
  /// Returns the sum of the last table's weights.
  double sum() const { return sum_; }

 private:
  friend std::vector<gpu::AliasEntry> build_alias_table(std::span<const float> weights);
  std::vector<gpu::AliasEntry> table_;
  std::vector<double> scaled_;
  double sum_ = 0;
  std::vector<std::uint32_t> columns_;  // those below 1 from the front, those above from the back
};

}  // namespace nightcity::scene
