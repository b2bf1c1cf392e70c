// Places that a table holds as texts which GDAL does not read.
#pragma once

#include <ogrsf_frmts.h>

#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "tools/inventory/inventory.h"

namespace nightcity::inventory {

/// Reads places of rows without a geometry: degrees, minutes and seconds in two columns, and
/// geometries with their CRS before them ("SRID=4326;POINT(13.4 52.5)", PostGIS' EWKT).
class TextPlaces {
 public:
  TextPlaces(OGRLayer& layer, const InventoryFile& inventory);

  /// Returns the CRS of the first geometry that names one, as "EPSG:4326"; "" where none does.
  const std::string& crs() const { return crs_; }

  /// Columns of east or longitude, north or latitude and whole geometries; -1 without.
  int x() const { return x_; }
  int y() const { return y_; }
  int geometry() const { return geometry_; }
  /// Returns whether there are columns for two coordinates.
  bool has_columns() const { return x_ >= 0 && y_ >= 0; }
  /// Returns whether one of the first 100 rows has angles there that are no plain numbers.
  bool begins_with_angles() const { return begins_with_angles_; }
  /// Returns whether one of the first 100 rows has numbers there whose digits stand in groups.
  bool begins_with_groups() const { return begins_with_groups_; }

  /// Returns the geometry of a row by its text in a form that GDAL does not take: EWKT, a feature
  /// of GeoJSON, WKB behind "\x" or "0x"; null without. Throws Error where it names another CRS
  /// than the first.
  OGRGeometryUniquePtr read_geometry(const OGRFeature& row) const;
  /// Returns longitude and latitude of a row by two columns with angles.
  std::optional<glm::dvec2> read_lon_lat(const OGRFeature& row) const;
  /// Returns a row's place in a grid by two columns with numbers of whose digits some stand in
  /// groups ("2'600'000", "391 403,3", "5.817.859,1"); none where the table has angles.
  std::optional<glm::dvec2> read_grouped(const OGRFeature& row) const;

 private:
  void look_at(const OGRFeature& row);
  std::string text_of(const OGRFeature& row, int column) const;

  std::string file_, crs_;
  int x_ = -1, y_ = -1, geometry_ = -1;
  bool begins_with_angles_ = false, begins_with_groups_ = false;
};

}  // namespace nightcity::inventory
