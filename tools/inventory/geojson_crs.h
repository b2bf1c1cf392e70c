// The CRS of a GeoJSON where it is said in a form that GDAL takes for none.
#pragma once

#include <string>

namespace nightcity::inventory {

/// Returns the CRS that the member "crs" of a GeoJSON says as PROJJSON or as a plain text
/// ("EPSG:25833"), which stands in the first or the last 64 kB; "" where there is none in these
/// forms. `path`: as GDAL takes it.
std::string find_odd_crs(const std::string& path);

}  // namespace nightcity::inventory
