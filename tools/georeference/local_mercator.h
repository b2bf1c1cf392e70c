// A plane for a city whose coordinates are degrees.
#pragma once

#include <GeographicLib/TransverseMercator.hpp>
#include <glm/vec2.hpp>
#include <string>

namespace nightcity::georeference {

/// Conformal plane around one place, in metres: a transverse Mercator with scale 1 on its central
/// meridian.
///
/// A local tangent plane (GeographicLib::LocalCartesian) would not do: its "up" is the axis at one
/// point, so a level street sinks 2 m in 5 km and the file's heights no longer mean heights. On a
/// map grid heights pass through unchanged, and distances are true to 1 part in 10^6 within 9 km of
/// the central meridian.
class LocalMercator {
 public:
  /// `centre`: longitude, latitude, degrees; it becomes (0, 0). The ellipsoid is that of the CRS.
  LocalMercator(double semi_major_m, double inverse_flattening, const glm::dvec2& centre);

  /// Degrees to metres east and north of the centre; NaN for what is no place.
  glm::dvec2 forward(const glm::dvec2& lon_lat) const;
  glm::dvec2 reverse(const glm::dvec2& east_north) const;
  /// The same projection as PROJ writes it.
  std::string proj_string() const;

 private:
  GeographicLib::TransverseMercator projection_;
  double lon0_, lat0_, y0_ = 0;
  double semi_major_m_, inverse_flattening_;
};

}  // namespace nightcity::georeference
