// The lights of a scene as a layer of points, for geographic information systems.
#pragma once

#include <cstddef>
#include <filesystem>

#include "formats/light_file.h"

namespace nightcity::exports {

/// Writes a GeoPackage (.gpkg) or a FlatGeobuf (.fgb) with a row for each light: its place
/// (easting, northing, height in the scene's CRS), identity, family, flux, colour, direction, size,
/// hours, and where each value comes from. Vehicles have no place and are left out. Returns the
/// number of rows. The file gets its name when it is complete. Throws Error: another ending, a CRS
/// that GDAL does not know, the file cannot be written.
std::size_t write_light_layer(const LightFile& lights, const std::filesystem::path& path);

}  // namespace nightcity::exports
