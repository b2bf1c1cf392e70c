// The two columns of a table that hold its places, by their names.
#pragma once

#include <ogrsf_frmts.h>

#include <string>
#include <string_view>
#include <vector>

namespace nightcity::inventory {

struct CoordinateColumns {
  int x = -1, y = -1;  // east or longitude, north or latitude; -1: there are none
};

/// Returns the columns whose names are one pair's, as open portals write it in many languages:
/// "lon" and "lat", "Rechtswert" and "Hochwert". Words that say more of both may stand beside them
/// ("GPS_LON", "coord. x", "x (WGS84)", "decimalLongitude"). A pair alone counts before one with
/// such words, and degrees before grids.
CoordinateColumns find_coordinate_columns(OGRFeatureDefn& columns);
CoordinateColumns find_coordinate_columns(const std::vector<std::string>& names);

/// Returns whether a column of this name holds latitude and longitude in one text ("48.85, 2.35"),
/// as portals name it.
bool is_name_of_points(std::string_view name);

/// Returns whether a list of two numbers in a column of this name has latitude first, as in
/// OpenDataSoft's geo_point_2d and what is named "latlng". In others it is longitude, as in
/// GeoJSON, MongoDB and Elasticsearch.
bool puts_latitude_first(std::string_view name);

/// Returns whether some of these names are those of columns with places: one pair's, a whole
/// geometry's, or that of points in one text.
bool have_names_of_places(const std::vector<std::string>& names);

}  // namespace nightcity::inventory
