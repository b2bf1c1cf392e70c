// The middle value of many.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace nightcity {

/// Returns the value in the middle of the sorted order (of an even number, the greater of the two middle
/// ones), or `if_empty` where there are no values.
template <class Value>
Value median(std::vector<Value> values, Value if_empty = {}) {
  if (values.empty()) return if_empty;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace nightcity
