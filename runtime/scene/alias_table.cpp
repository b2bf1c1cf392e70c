#include "runtime/scene/alias_table.h"

#include <limits>
#include <utility>

namespace nightcity::scene {

std::span<const gpu::AliasEntry> AliasTableBuilder::build(std::span<const float> weights) {
  const std::size_t n = weights.size();
  scaled_.resize(n);
  table_.resize(n);
  columns_.resize(n);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const bool counts = weights[i] > 0 && weights[i] <= std::numeric_limits<float>::max();
    scaled_[i] = counts ? double(weights[i]) : 0.0;
    sum += scaled_[i];
  }
  sum_ = sum;
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
  if (smalls == 0 || larges == n) return table_;
  // A large column fills up small ones until it is small itself. What is left of it stays in a
  // register, because each step waits for the one before.
  std::uint32_t small = columns_[--smalls], large = columns_[larges];
  double left = scaled_[large], of_small = scaled_[small];
  while (true) {
    table_[small] = {static_cast<float>(of_small), large};
    left -= 1.0 - of_small;
    if (left < 1.0) {
      small = large;
      of_small = left;
      if (++larges == n) break;
      large = columns_[larges];
      left = scaled_[large];
    } else {
      if (smalls == 0) break;
      small = columns_[--smalls];
      of_small = scaled_[small];
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
