// The coordinate reference system (CRS) of a raster.
#pragma once

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <filesystem>
#include <optional>
#include <string>

namespace nightcity::terrain {

/// Returns the CRS that the raster names, else that of a .prj beside it, which GDAL reads of some
/// formats alone, else `otherwise` ("EPSG:25832"; "": none). Throws Error where that is none that
/// PROJ knows.
std::optional<OGRSpatialReference> find_raster_crs(GDALDataset& raster,
                                                   const std::filesystem::path& file,
                                                   const std::string& otherwise);

}  // namespace nightcity::terrain
