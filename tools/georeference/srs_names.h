// srsName strings as producers write them, turned into definitions PROJ understands.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nightcity::georeference {

/// Returns definitions to try with PROJ, best first; none where there is no name. The name as
/// written comes first unless PROJ would take it for something else ("CH1903" is a geographic CRS
/// to PROJ, while files mean the projected one).
std::vector<std::string> list_crs_definitions(std::string_view srs_name);

/// The promise that the form of a CRS's name makes about the order of coordinates.
enum class AxisPromise : std::uint8_t {
  east_north,      // "EPSG:n", GML 2's epsg.xml#n and plain names: easting, northing
  register_order,  // meant as a URN, but not well formed: the EPSG register's order, not certain
  fixed,           // URN (OGC 07-092r3) and http://www.opengis.net/def/crs: the register's order
};
AxisPromise find_axis_promise(std::string_view srs_name);

}  // namespace nightcity::georeference
