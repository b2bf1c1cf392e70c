// Latitude and longitude of a city's coordinates.
#pragma once

#include <GeographicLib/TransverseMercator.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

namespace nightcity::viewer {

/// Converts between a city's CRS and geographic coordinates (WGS 84; ETRS89 and JGD2011 differ from
/// it by less than a metre). It knows the transverse Mercators that most cities come in: UTM
/// (EPSG:326zz, 327zz, 258zz), Japan's plane zones (EPSG:6669 to 6687), and those that nightbake
/// makes for cities given in degrees.
class MapProjection {
 public:
  /// `crs`: as Georeference has it. Without one, or with one that is none of these, the object
  /// converts nothing.
  explicit MapProjection(const std::string& crs);

  bool is_usable() const { return grid_.has_value(); }
  /// Returns easting and northing, m; nothing outside the CRS's reach.
  std::optional<glm::dvec2> to_plane(double latitude_deg, double longitude_deg) const;
  /// Returns latitude and longitude in degrees.
  std::optional<glm::dvec2> to_degrees(const glm::dvec2& easting_northing) const;

 private:
  struct Grid {
    GeographicLib::TransverseMercator mercator;
    double meridian_deg;
    glm::dvec2 shift;  // of its eastings and northings, m
  };
  std::optional<Grid> grid_;
};

}  // namespace nightcity::viewer
