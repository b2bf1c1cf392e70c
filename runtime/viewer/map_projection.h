// Latitude and longitude of a city's coordinates.
#pragma once

#include <GeographicLib/TransverseMercator.hpp>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "formats/geographic_fit.h"

namespace nightcity::viewer {

/// Converts between a city's CRS and geographic coordinates (WGS 84; ETRS89 and JGD2011 differ from
/// it by less than a metre), by the polynomials in the scene's file. Files without them come from
/// before these; then it knows the transverse Mercators that most cities come in: UTM (EPSG:326zz,
/// 327zz, 258zz), Japan's plane zones (EPSG:6669 to 6687), and those that nightbake makes for
/// cities given in degrees.
class MapProjection {
 public:
  /// `crs`: as Georeference has it. Without `fit`, and with a CRS that is none of these, the object
  /// converts nothing.
  explicit MapProjection(const std::string& crs, const std::optional<GeographicFit>& fit = {});

  bool is_usable() const { return fit_ || grid_; }
  /// Returns easting and northing, m; nothing outside the reach of polynomials or CRS.
  std::optional<glm::dvec2> to_plane(double latitude_deg, double longitude_deg) const;
  /// Returns latitude and longitude in degrees.
  std::optional<glm::dvec2> to_degrees(const glm::dvec2& easting_northing) const;

 private:
  struct Grid {
    GeographicLib::TransverseMercator mercator;
    double meridian_deg;
    glm::dvec2 shift;  // of its eastings and northings, m
  };
  std::optional<GeographicFit> fit_;
  std::optional<Grid> grid_;  // where there is no fit
};

}  // namespace nightcity::viewer
