// Places a scene on the ellipsoid of WGS 84, for formats that show the whole Earth.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>

#include "tools/georeference/frame.h"

namespace nightcity::exports {

/// Returns earth-centred, earth-fixed coordinates (m) of a place: degrees, m above the ellipsoid.
glm::dvec3 to_ecef(const glm::dvec2& lon_lat, double height_m);

class PlaceOnEarth {
 public:
  /// `crs`, `place`: of the scene, and some place in it. `geoid_m`: height of the zero of the
  /// scene's heights above the ellipsoid. Throws Error where the CRS is unknown, or is none.
  PlaceOnEarth(const std::string& crs, const glm::dvec3& place, double geoid_m);

  /// Returns WGS 84 degrees.
  glm::dvec2 to_lon_lat(const glm::dvec2& east_north) const;
  double to_ellipsoid(double height_m) const { return height_m + geoid_m_; }

  /// Returns the matrix, by columns, from a frame at a place (E, N, H) to the Earth: x along the
  /// grid's east, y along its north, z up. It holds the scale of the grid, so that a metre of the
  /// grid has its true length on the ground there.
  std::array<double, 16> make_transform(const glm::dvec3& place) const;

 private:
  georeference::CityFrame frame_;
  double geoid_m_;
};

}  // namespace nightcity::exports
