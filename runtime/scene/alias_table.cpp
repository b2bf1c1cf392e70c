#include "runtime/scene/alias_table.h"

#include <cmath>

namespace nightcity::scene {

std::vector<gpu::AliasEntry> build_alias_table(std::span<const float> weights) {
  const std::size_t n = weights.size();
  std::vector<double> scaled(n);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    scaled[i] = std::isfinite(weights[i]) && weights[i] > 0 ? double(weights[i]) : 0.0;
    sum += scaled[i];
  }
  std::vector<gpu::AliasEntry> table(n);
  std::vector<std::uint32_t> small, large;
  for (std::size_t i = 0; i < n; ++i) {
    const double pdf = sum > 0 ? scaled[i] / sum : 1.0 / double(n);
    table[i] = {1.0f, static_cast<std::uint32_t>(i), static_cast<float>(pdf)};
    scaled[i] = pdf * double(n);
    (scaled[i] < 1.0 ? small : large).push_back(static_cast<std::uint32_t>(i));
  }
  while (!small.empty() && !large.empty()) {
    const std::uint32_t s = small.back(), l = large.back();
    small.pop_back();
    table[s].keep = static_cast<float>(scaled[s]);
    table[s].alias = l;
    scaled[l] -= 1.0 - scaled[s];
    if (scaled[l] < 1.0) {
      large.pop_back();
      small.push_back(l);
    }
  }
  // The columns that are left differ from 1 by rounding only, and keep themselves.
  return table;
}

}  // namespace nightcity::scene
