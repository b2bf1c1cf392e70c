// The coordinate reference system (CRS) of a raster.
#pragma once

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <optional>
#include <string>

namespace nightcity::terrain {

/// Returns the CRS that the raster names, else that of a .prj beside it, which GDAL reads of some
/// formats alone, else `otherwise` ("EPSG:25832"; "": none). `path`: as GDAL takes it; `name`: for
/// messages. Throws Error where that is none that PROJ knows.
std::optional<OGRSpatialReference> find_raster_crs(GDALDataset& raster, const std::string& path,
                                                   const std::string& name,
                                                   const std::string& otherwise);

}  // namespace nightcity::terrain
