// srsName strings as producers write them, turned into definitions PROJ understands.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nightcity {

/// Returns definitions to try with PROJ, best first; none where there is no name. The name as
/// written comes first unless PROJ would take it for something else ("CH1903" is a geographic CRS
/// to PROJ, while files mean the projected one).
std::vector<std::string> list_crs_definitions(std::string_view srs_name);

/// Returns whether the form of the name promises the axis order of the EPSG register: urn and
/// opengis.net/def forms do; "EPSG:n", GML 2's epsg.xml#n and plain names mean easting, northing.
bool promises_register_axis_order(std::string_view srs_name);

}  // namespace nightcity
