// Zones of UTM.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <string>

namespace nightcity::georeference {

/// Returns the CRS of the zone of UTM (WGS 84) that a place lies in, by longitude and the side of
/// the equator alone: "EPSG:32633". Longitudes may count on beyond 180 degrees.
inline std::string find_utm_zone(const glm::dvec2& lon_lat) {
  const double longitude = std::remainder(lon_lat.x, 360.0);
  const int zone = std::clamp(static_cast<int>(std::floor((longitude + 180) / 6)) + 1, 1, 60);
  return "EPSG:" + std::to_string((lon_lat.y < 0 ? 32700 : 32600) + zone);
}

}  // namespace nightcity::georeference
