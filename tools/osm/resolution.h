// The resolution in which maps give places.
#pragma once

#include <cmath>
#include <cstdint>

namespace nightcity::osm {

constexpr double resolution_degrees = 1e-7;

/// Returns degrees in steps of the resolution. They must be finite.
inline std::int64_t to_steps(double degrees) {
  return std::llround(degrees / resolution_degrees);
}

/// Returns degrees as the readers of maps round them, so that one place is the same numbers
/// wherever it was read. The degrees must be finite.
inline double round_degrees(double degrees) {
  return static_cast<double>(to_steps(degrees)) * resolution_degrees;
}

}  // namespace nightcity::osm
