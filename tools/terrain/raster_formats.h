// The formats of rasters that GDAL may read here.
#pragma once

#include <gdal_priv.h>

#include <string>

namespace nightcity::terrain {

/// Returns the short names of the drivers that may open a raster, terminated by null as GDAL wants
/// it.
const char* const* list_allowed_drivers();

/// Returns the short name of the format of a raster that GDAL could open and we do not; null for
/// other files.
const char* find_refused_format(const std::string& file);

/// Returns whether a raster is a text in which GDAL finds a row by those before it.
bool has_text_rows(GDALDataset& raster);

}  // namespace nightcity::terrain
