// The transfer function of sRGB, IEC 61966-2-1.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace nightcity {

/// Both take and return values from 0 to 1.
inline double linear_from_srgb(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}
inline double srgb_from_linear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

/// Returns the same for all values of a byte.
inline const std::array<double, 256>& list_linear_of_srgb8() {
  static const auto table = [] {
    std::array<double, 256> values;
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = linear_from_srgb(static_cast<double>(i) / 255);
    return values;
  }();
  return table;
}
inline double linear_from_srgb8(std::uint8_t srgb) {
  return list_linear_of_srgb8()[srgb];
}
/// Rounds to the nearest; NaN becomes 0.
inline std::uint8_t srgb8_from_linear(double linear) {
  static const auto bounds = [] {  // between each value and the next
    std::array<double, 255> values;
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = linear_from_srgb((static_cast<double>(i) + 0.5) / 255);
    return values;
  }();
  if (!(linear > 0)) return 0;
  return static_cast<std::uint8_t>(std::upper_bound(bounds.begin(), bounds.end(), linear) -
                                   bounds.begin());
}

}  // namespace nightcity
