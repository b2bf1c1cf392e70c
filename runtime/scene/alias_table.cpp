#include "runtime/scene/alias_table.h"

#include <cmath>
#include <utility>

namespace nightcity::scene {

std::span<const gpu::AliasEntry> AliasTableBuilder::build(std::span<const float> weights) {
  const std::size_t n = weights.size();
  scaled_.resize(n);
  table_.resize(n);
  columns_.resize(n);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    scaled_[i] = std::isfinite(weights[i]) && weights[i] > 0 ? double(weights[i]) : 0.0;
    sum += scaled_[i];
  }
  const double per_weight = sum > 0 ? 1 / sum : 0, uniform = 1.0 / double(n);
  std::size_t smalls = 0, larges = n;  // columns_[0, smalls) and columns_[larges, n)
  for (std::size_t i = 0; i < n; ++i) {
    const double pdf = sum > 0 ? scaled_[i] * per_weight : uniform;
    table_[i] = {1.0f, static_cast<std::uint32_t>(i)};
    scaled_[i] = pdf * double(n);
    const bool small = scaled_[i] < 1.0;
    columns_[small ? smalls : larges - 1] = static_cast<std::uint32_t>(i);
    smalls += small;
    larges -= !small;
  }
  while (smalls > 0 && larges < n) {
    const std::uint32_t s = columns_[--smalls], l = columns_[larges];
    table_[s].keep = static_cast<float>(scaled_[s]);
    table_[s].alias = l;
    scaled_[l] -= 1.0 - scaled_[s];
    if (scaled_[l] < 1.0) {
      ++larges;
      columns_[smalls++] = l;
    }
  }
  // The columns that are left differ from 1 by rounding only, and keep themselves.
  return table_;
}

std::vector<gpu::AliasEntry> build_alias_table(std::span<const float> weights) {
  AliasTableBuilder builder;
  builder.build(weights);
  return std::move(builder.table_);
}

}  // namespace nightcity::scene
