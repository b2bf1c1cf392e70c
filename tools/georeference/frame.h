// Coordinates of a city's files, and longitude and latitude (OSM), to the scene's projected frame.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "formats/georeference.h"

namespace nightcity::georeference {

/// The frame of one city: E, N, H in metres. A projected CRS stays as it is but for its axis order;
/// a geographic one (PLATEAU's lat, lon, h) goes through a transverse Mercator centred on the city
/// (GeographicLib), which leaves heights alone.
class CityFrame {
 public:
  /// One place known in both systems: for a model that names no CRS.
  struct ControlPoint {
    glm::dvec2 lon_lat{0, 0};  // WGS 84, degrees
    glm::dvec2 model{0, 0};    // the file's own x, y
  };
  struct Options {
    std::string crs_override;  // "" = believe srs_name; "none" = no CRS, whatever the file says
    std::vector<ControlPoint> control_points;  // two or more place a model that has no CRS
  };

  /// `srs_name`: as written in the file. `sample`: some of its coordinates, to find the axis order
  /// and to check that they lie in the CRS's area of use. Without a name and an override
  /// coordinates pass through as E, N, H in metres, crs() is "", and longitude and latitude need
  /// Options::control_points. Throws Error when neither PROJ nor the alias table knows the CRS, or
  /// when no axis order puts the sample inside the area of use.
  static CityFrame from_srs_name(const std::string& srs_name, std::span<const glm::dvec3> sample,
                                 const Options& options);

  /// Source coordinates (as in the file) to E, N, H in metres, in place.
  void to_projected(std::span<glm::dvec3> coordinates) const;
  /// The same for a shape that is placed at `anchor`: where the CRS is geographic or its grid no
  /// metric one (Pseudo-Mercator), differences to that are metres east, north and up. Without an
  /// anchor as above.
  void to_projected(std::span<glm::dvec3> coordinates,
                    const std::optional<glm::dvec3>& anchor) const;
  /// WGS 84 degrees to E, N in metres; NaN where PROJ has no answer. Horizontal only: heights come
  /// from the terrain. Throws Error when has_lon_lat() is false. Safe to call from several threads.
  glm::dvec2 from_lon_lat(const glm::dvec2& lon_lat) const;
  glm::dvec2 to_lon_lat(const glm::dvec2& east_north) const;

  double height_unit_m() const;    // metres in the unit of the source's heights
  bool has_lon_lat() const;        // false: no CRS and no control points
  const std::string& crs() const;  // "EPSG:25833" or a PROJ string
  /// For the report: CRS, axis order and its reason, operation and its accuracy.
  const std::string& description() const;
  /// Returns "axes are taken as north, east: ..." where the file contradicts its CRS's name, or
  /// follows it with surfaces that face inward; "" where nothing is doubtful.
  const std::string& axis_warning() const;

  CityFrame(CityFrame&&) noexcept;
  CityFrame& operator=(CityFrame&&) noexcept;
  ~CityFrame();

 private:
  struct State;
  explicit CityFrame(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace nightcity::georeference
