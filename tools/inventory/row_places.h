// The places of one row of a table.
#pragma once

#include <ogr_geometry.h>

#include <glm/vec2.hpp>
#include <vector>

namespace nightcity::inventory {

/// Returns the points of a point, points together or a collection of these; none of other
/// geometries, and of null.
std::vector<glm::dvec2> find_places(const OGRGeometry* geometry);

/// Returns whether a place is what programs write that know none: 0, 0 lies in the Gulf of Guinea,
/// and on the origin of a grid no more than one lamp can stand.
bool is_unfilled(const glm::dvec2& place);

}  // namespace nightcity::inventory
