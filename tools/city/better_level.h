// Chooses between levels of detail.
#pragma once

namespace nightcity::city {

/// Returns whether level `a` is to be shown rather than `b`: the highest up to `limit` is, else the
/// lowest above. Both, and the limit, may be times a factor.
inline bool is_better_level(int a, int b, int limit) {
  const bool a_within = a <= limit, b_within = b <= limit;
  if (a_within != b_within) return a_within;
  return a_within ? a > b : a < b;
}

}  // namespace nightcity::city
