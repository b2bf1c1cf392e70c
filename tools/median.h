// The middle value of many.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace nightcity {

/// Returns the value in the middle of the sorted order (of an even number, the greater of the two middle
/// ones). `values` must not be empty; the function takes its own copy, since it changes the order.
template <class Value>
Value median(std::vector<Value> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace nightcity
