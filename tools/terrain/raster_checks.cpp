#include "tools/terrain/raster_checks.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_vsi.h>

#include <array>
#include <cstdint>
#include <string_view>

#include "formats/error.h"
#include "formats/packed_file.h"
#include "formats/to_lower.h"
#include "tools/city/foreign_format.h"
#include "tools/city/packing.h"

namespace nightcity::terrain {

void refuse_picture(GDALDataset& dataset, const std::string& name) {
  const auto holds = [&](GDALColorInterp colour) {
    for (int i = 1; i <= dataset.GetRasterCount(); ++i)
      if (dataset.GetRasterBand(i)->GetColorInterpretation() == colour) return true;
    return false;
  };
  if (holds(GCI_PaletteIndex) ||
      (holds(GCI_RedBand) && holds(GCI_GreenBand) && holds(GCI_BlueBand)))
    throw Error(name,
                "is a picture in colours, no raster of heights: fetch the elevation model itself, "
                "whose only band holds heights");
}

// GDAL makes one mask of no-data values and mask bands (its RFC 15), and of alpha bands in bytes;
// beside heights these are often floats.
std::vector<GDALRasterBand*> find_masks(GDALDataset& dataset, GDALRasterBand& heights) {
  std::vector<GDALRasterBand*> masks;
  if ((heights.GetMaskFlags() & GMF_ALL_VALID) == 0) masks.push_back(heights.GetMaskBand());
  for (int i = 2; i <= dataset.GetRasterCount(); ++i)
    if (dataset.GetRasterBand(i)->GetColorInterpretation() == GCI_AlphaBand)
      masks.push_back(dataset.GetRasterBand(i));
  return masks;
}

int count_alpha_bands(GDALDataset& dataset) {
  int count = 0;
  for (int i = 1; i <= dataset.GetRasterCount(); ++i)
    count += dataset.GetRasterBand(i)->GetColorInterpretation() == GCI_AlphaBand;
  return count;
}

void refuse_large_blocks(GDALRasterBand& band, int max_mpx, const std::string& name) {
  int width = 0, height = 0;
  band.GetBlockSize(&width, &height);
  if (std::int64_t{width} * height > std::int64_t{max_mpx} * 1'000'000)
    throw Error(name, "comes in blocks of " + std::to_string(width) + " x " +
                          std::to_string(height) +
                          " pixels: write it in tiles (gdal_translate -co TILED=YES), or raise "
                          "[terrain] max_dem_block_mpx in a recipe");
}

bool says_points_in_no_order() {
  return std::string_view(CPLGetLastErrorMsg()).starts_with("Ungridded");
}

std::string explain_unread_raster(const std::string& path) {
  const std::string said = CPLGetLastErrorMsg();
  std::array<char, 4096> bytes{};
  VSILFILE* const file = VSIFOpenL(path.c_str(), "rb");
  const std::size_t size = file ? VSIFReadL(bytes.data(), 1, bytes.size(), file) : 0;
  if (file) VSIFCloseL(file);
  const std::string_view start(bytes.data(), size);
  if (start.empty()) return "it is empty";
  if (start.starts_with("\x1f\x8b")) return "it is packed by gzip: unpack it first (gunzip)";
  if (city::find_packing(start) == city::Packing::zip)
    return "it is a zip archive: unpack it first";
  if (const std::string_view packed = describe_packed(start); !packed.empty())
    return "it " + std::string(packed);
  if (says_points_in_no_order())
    return said + "; its points stand on no grid: make a raster of them (gdal_grid)";
  if (!said.empty()) return said;
  const std::string ending = to_lower(CPLGetExtension(path.c_str()));
  VSIStatBufL status;
  if ((ending == "flt" || ending == "bil") &&
      VSIStatL(CPLResetExtension(path.c_str(), "hdr"), &status) != 0)
    return "the .hdr that belongs to it is missing";
  if (const std::string what = city::name_foreign(start, ""); !what.empty())
    return "it " + what + "; a raster of heights is a GeoTIFF, say";
  return "it is in none of the formats of rasters that are read (GeoTIFF, ...)";
}

}  // namespace nightcity::terrain
