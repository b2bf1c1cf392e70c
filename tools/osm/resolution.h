// The resolution in which maps give places.
#pragma once

#include <cmath>

namespace nightcity::osm {

constexpr double resolution_degrees = 1e-7;

/// Returns degrees as the readers of maps round them, so that one place is the same numbers
/// wherever it was read. The degrees must be finite.
inline double round_degrees(double degrees) {
  return static_cast<double>(std::lround(degrees / resolution_degrees)) * resolution_degrees;
}

}  // namespace nightcity::osm
