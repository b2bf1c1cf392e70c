// Longitudes beside the antimeridian, where 180 degrees east are 180 degrees west.
#pragma once

#include <cmath>

namespace nightcity::place {

/// Returns a longitude counted on from another that is near it on the globe: 180.5 for -179.5
/// beside 179.5. Elsewhere it is what it was, to the last bit.
inline double count_on(double longitude, double beside) {
  const double away = longitude - beside;
  return std::abs(away) <= 180 ? longitude : longitude - 360 * std::round(away / 360);
}

}  // namespace nightcity::place
