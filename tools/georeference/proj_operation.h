// The best operation that PROJ knows from WGS 84 to a CRS at a place.
#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "tools/georeference/proj_axes.h"

namespace nightcity::georeference {

/// Returns the operation from CRS 84 (longitude, latitude in degrees) to `crs` (its own axes) with
/// the best stated accuracy among those whose grids are installed and whose area of use holds
/// `place` (null: anywhere). A guess between datums is taken only where PROJ states nothing better.
/// Null when PROJ has none.
PjPtr find_operation_from_wgs84(PJ_CONTEXT* context, const PJ* crs, const glm::dvec2* place);

/// Returns whether PROJ knows no shift between the datums, and takes degrees of one for the
/// other's.
bool is_guess(PJ_CONTEXT* context, const PJ* operation);

/// Returns its name and stated accuracy, for a report.
std::string describe_operation(PJ_CONTEXT* context, const PJ* operation);

}  // namespace nightcity::georeference
