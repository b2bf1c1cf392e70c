// The places of one row of a table.
#pragma once

#include <ogr_geometry.h>
#include <ogrsf_frmts.h>

#include <glm/vec2.hpp>
#include <optional>
#include <vector>

namespace nightcity::inventory {

/// Returns the points of a point, points together or a collection of these; none of other
/// geometries, and of null.
std::vector<glm::dvec2> find_places(const OGRGeometry* geometry);

/// Returns whether a place is what programs write that know none: 0, 0 lies in the Gulf of Guinea,
/// and on the origin of a grid no more than one lamp can stand.
bool is_unfilled(const glm::dvec2& place);

/// Returns the column that says in which zone of UTM each row lies ("utm_zone", "huso"); -1
/// without.
int find_zone_column(OGRLayer& layer);

/// Returns the zone of UTM that a row says there: 33 of "33", "33N" or "33U". A plain number under
/// "zone" may be any zone.
std::optional<int> read_utm_zone(const OGRFeature& row, int column);

}  // namespace nightcity::inventory
