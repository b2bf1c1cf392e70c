// The median: a few outliers do not move it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace nightcity {

/// Returns the median (of an even number of values, the upper of the middle two), or `if_empty`
/// without values.
template <class Value>
Value median(std::vector<Value> values, Value if_empty = {}) {
  if (values.empty()) return if_empty;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace nightcity
