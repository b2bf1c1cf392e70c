// The operation from WGS 84 to a CRS that PROJ knows to be best at a place.
#pragma once

#include <glm/vec2.hpp>
#include <string>

#include "tools/georeference/proj_axes.h"

namespace nightcity {

/// From CRS 84 (longitude, latitude in degrees) to `crs` (its own axes). Among operations whose grids are
/// here and whose area of use holds `place` (null: anywhere) the one of the best stated accuracy, never a
/// guess between datums where a stated one exists. Null when PROJ has none.
PjPtr operation_from_wgs84(PJ_CONTEXT* context, const PJ* crs, const glm::dvec2* place);

/// Its name and stated accuracy, for a report.
std::string describe_operation(PJ_CONTEXT* context, const PJ* operation);

}  // namespace nightcity
