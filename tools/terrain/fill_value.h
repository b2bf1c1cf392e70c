// Numbers of rasters that stand for no height.
#pragma once

#include <gdal.h>

namespace nightcity::terrain {

/// Returns whether a value stands for no height although the raster does not declare it: beyond any
/// height on the Earth, or a number that producers write, and lower than any land. `stored`: the
/// pixel's.
bool is_fill_value(double stored, double metres);

/// Returns whether a pixel is an end of its type of whole numbers, which producers write where they
/// know nothing; a scale makes a height of it: -32768 in centimetres would be a pit of 328 m. 0 is
/// a height.
bool is_end_of_type(double stored, GDALDataType type);

}  // namespace nightcity::terrain
