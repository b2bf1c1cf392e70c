// One CRS known to PROJ: its axes, its area of use, and conversion from and to WGS 84.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>

namespace nightcity::georeference {

/// The horizontal part of a CRS. For one thread at a time, as PROJ objects are.
class SourceCrs {
 public:
  /// A user may name files in a definition (+nadgrids, +init), a stranger may not.
  enum class Writer : std::uint8_t { stranger, user };
  /// Returns null when PROJ does not know `definition`, it is neither projected nor geographic or
  /// names a file that it may not; then `why` says what is wrong.
  static std::unique_ptr<SourceCrs> create(const std::string& definition, std::string& why,
                                           Writer writer = Writer::stranger);
  ~SourceCrs();

  bool geographic() const;
  /// Returns whether the EPSG register puts northing or latitude first.
  bool north_first() const;
  /// Returns whether the axes of the register point west and south, as in South Africa and in
  /// Krovak's grid. Files of such CRSs often count east and north in negative numbers instead.
  bool counts_west_and_south() const;
  /// "EPSG:25833" where the register knows it and its axes are metres east and north; else a PROJ
  /// string in metres, else the name. Of a geographic CRS its own name.
  const std::string& identity() const;
  const std::string& name() const;
  double unit_to_metre() const;  // of a projected CRS's axes; 1 for a geographic one
  /// The unit of the vertical part; without one, heights share the horizontal unit.
  double height_unit_to_metre() const;
  double semi_major_m() const;
  double inverse_flattening() const;
  const std::string& area_name() const;
  bool has_area() const;  // PROJ states an area of use
  /// Returns what PROJ makes the geographic CRS below a projected one of.
  std::string base_definition() const;
  /// A projected CRS's grid at a place.
  struct LocalGrid {
    double scale = 1;         // its length of one metre on the ground, the mean of both axes
    double turn_degrees = 0;  // of its north from the true one, anticlockwise
  };
  /// Returns the grid at a place (degrees of the CRS's own datum); NaN where PROJ has no answer.
  LocalGrid find_grid(const glm::dvec2& lon_lat) const;
  /// Returns whether the grid is laid round a pole, so that its north is none.
  bool is_polar() const;

  /// WGS 84 degrees to (east, north) in metres or (longitude, latitude) in degrees of this CRS's
  /// datum from Greenwich, and back. NaN where PROJ has no answer.
  glm::dvec2 from_wgs84(const glm::dvec2& lon_lat) const;
  glm::dvec2 to_wgs84(const glm::dvec2& east_north) const;

  /// Numbers as in a file, east first and with signs of east and north, to metres or degrees from
  /// Greenwich: feet, grads and longitudes from Paris, Ferro or Rome are turned.
  glm::dvec2 to_metres_or_degrees(const glm::dvec2& numbers) const;

  /// (east, north) to longitude, latitude of the CRS's own datum, which lie within some 100 m of
  /// WGS 84, from Greenwich. Needs no operation between datums, whose choice takes PROJ from a
  /// tenth of a second to several.
  glm::dvec2 to_own_lon_lat(const glm::dvec2& east_north) const;

  /// Returns whether a place (degrees) lies in the area of use, widened by `margin_deg`. True when
  /// PROJ states no area.
  bool area_contains(const glm::dvec2& lon_lat, double margin_deg) const;

  /// Chooses the operation from WGS 84 for a place (degrees; null: for the whole area of use).
  /// Returns PROJ's name for it with the stated accuracy. Throws Error when there is none, or when
  /// the definition names a file that it may not. Must be called before from_wgs84 and to_wgs84.
  std::string select_operation(const glm::dvec2* lon_lat);

  /// Returns what is to be told where its datum is one from before satellites whose shift to WGS 84
  /// PROJ does not know; "" for others. Needs the operation.
  std::string doubt() const;

 private:
  SourceCrs();
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nightcity::georeference
