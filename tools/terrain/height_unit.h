// The unit of a raster's heights.
#pragma once

#include <string>

class GDALRasterBand;
class OGRSpatialReference;

namespace nightcity::terrain {

/// Returns the metres in the unit of a band's values: the unit that the band names, else that of
/// the vertical part of `crs` (may be null), else 1. Throws Error, which names `file`, if the band
/// names a unit that is no known length.
double find_height_unit(GDALRasterBand& band, const OGRSpatialReference* crs,
                        const std::string& file);

/// Returns whether nothing names a unit of heights while the plan of `crs` (may be null) is in
/// another than metres: such heights are often in that unit too, and often in metres.
bool assumes_metres(GDALRasterBand& band, const OGRSpatialReference* crs);

/// Returns whether the vertical part of `crs` (may be null) counts depths and no heights.
bool counts_downward(const OGRSpatialReference* crs);

}  // namespace nightcity::terrain
