// Tables of x y z whose points come in no order, as rasters.
#pragma once

#include <gdal_priv.h>

#include <cstddef>
#include <string>

namespace nightcity::terrain {

/// Points that are held in memory, 24 bytes each, and their grid beside them.
constexpr std::size_t max_loose_points = 20'000'000;

/// Returns a raster in memory of the points of a table, which may come in any order: NaN where the
/// grid has none. Null where they lie on no grid along the axes (each within a hundredth of a
/// step), or fill less than an eighth of it. Columns are found as GDAL finds them: by headings,
/// else the first three are x, y and z. `path`: as GDAL takes it; `name`: for messages. Throws
/// Error: more than `max_points`, or two heights in one place.
GDALDatasetUniquePtr grid_loose_points(const std::string& path, const std::string& name,
                                       std::size_t max_points = max_loose_points);

}  // namespace nightcity::terrain
