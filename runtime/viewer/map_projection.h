// Latitude and longitude of a city's coordinates.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>

namespace nightcity::viewer {

/// Converts between a city's CRS and geographic coordinates (WGS 84; in Europe ETRS89 differs from it
/// by less than a metre).
class MapProjection {
 public:
  /// `crs`: as Georeference has it. Without one, or with one that PROJ does not know, the object
  /// converts nothing.
  explicit MapProjection(const std::string& crs);
  ~MapProjection();
  MapProjection(const MapProjection&) = delete;
  MapProjection& operator=(const MapProjection&) = delete;

  bool is_usable() const { return state_ != nullptr; }
  /// Returns easting and northing, m; nothing outside the CRS's reach.
  std::optional<glm::dvec2> to_plane(double latitude_deg, double longitude_deg) const;
  /// Returns latitude and longitude in degrees.
  std::optional<glm::dvec2> to_degrees(const glm::dvec2& easting_northing) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nightcity::viewer
