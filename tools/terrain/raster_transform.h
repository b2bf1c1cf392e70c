// The place of a raster's pixels.
#pragma once

#include <gdal_priv.h>

#include <string>

namespace nightcity::terrain {

/// Gives the raster's geotransform, or else the one on which its ground control points lie, to a
/// quarter of a pixel. Throws Error where there is none, with what helps.
void find_raster_transform(GDALDataset& dataset, const std::string& file, double (&from_pixel)[6]);

}  // namespace nightcity::terrain
