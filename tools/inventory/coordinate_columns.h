// The two columns of a table that hold its places, by their names.
#pragma once

#include <ogrsf_frmts.h>

namespace nightcity::inventory {

struct CoordinateColumns {
  int x = -1, y = -1;  // east or longitude, north or latitude; -1: there are none
};

/// Returns the columns whose names are one pair's, as open portals write it in many languages:
/// "lon" and "lat", "Rechtswert" and "Hochwert". Words that say more of both may stand beside them
/// ("GPS_LON", "coord. x", "x (WGS84)", "decimalLongitude"). A pair alone counts before one with
/// such words, and degrees before grids.
CoordinateColumns find_coordinate_columns(OGRFeatureDefn& columns);

}  // namespace nightcity::inventory
