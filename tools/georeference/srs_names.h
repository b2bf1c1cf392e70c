// srsName strings as producers write them, turned into definitions PROJ understands.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nightcity {

/// Definitions to try with PROJ, best first. The name as written comes first unless PROJ would take it for
/// something else ("CH1903" is a geographic CRS to PROJ, while files mean the projected one). Empty: no name.
std::vector<std::string> crs_definitions(std::string_view srs_name);

/// Whether the form of the name promises the axis order of the EPSG register (urn and opengis.net/def forms
/// do; "EPSG:n", GML 2's epsg.xml#n and plain names mean easting, northing).
bool promises_register_axis_order(std::string_view srs_name);

}  // namespace nightcity
