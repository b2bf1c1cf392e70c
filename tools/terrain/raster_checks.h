// Refusals of rasters that hold no heights, or cannot be read.
#pragma once

#include <gdal_priv.h>

#include <string>
#include <vector>

namespace nightcity::terrain {

/// Throws Error where a raster is a picture: colours are no heights, though its numbers can be read
/// as such. `name` is for messages, here and below.
void refuse_picture(GDALDataset& dataset, const std::string& name);

/// Throws Error where a block, which GDAL unpacks as a whole, has more million pixels.
void refuse_large_blocks(GDALRasterBand& band, int max_mpx, const std::string& name);

/// Returns bands that are zero where there are no heights.
std::vector<GDALRasterBand*> find_masks(GDALDataset& dataset, GDALRasterBand& heights);

/// Returns how many bands say which pixels count.
int count_alpha_bands(GDALDataset& dataset);

/// Returns whether GDAL said last that a table of points is no raster.
bool says_points_in_no_order();

/// Returns what GDAL said of a file that it does not read or, where it knows nothing of it, what
/// that is. `path`: as GDAL takes it.
std::string explain_unread_raster(const std::string& path);

}  // namespace nightcity::terrain
