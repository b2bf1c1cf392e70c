// Eastings in UTM that begin with the number of their zone.
#pragma once

#include <cmath>

namespace nightcity::gdal {

/// Returns an easting without the number of the zone that surveys of Germany write before it:
/// 391020 of 33391020 in zone 33. Others stay: no easting of UTM is as large. So do those in zones
/// below 10, which a northing in the place of an easting would look like. `zone`: that of the CRS;
/// 0: it is not UTM.
inline double take_zone_off(double easting, int zone) {
  constexpr double shift = 1e6;
  constexpr int least = 10;
  return zone >= least && std::floor(easting / shift) == zone ? easting - zone * shift : easting;
}

}  // namespace nightcity::gdal
