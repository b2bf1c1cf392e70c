#include "tools/elevation/dem_raster.h"

#include <cmath>
#include <span>

#include "formats/error.h"

namespace nightcity::elevation {

DemRaster::DemRaster(const std::filesystem::path& file, int max_block_mpx,
                     const std::string& crs_without)
    : model_(file, max_block_mpx, crs_without) {
  if (!model_.has_crs())
    throw Error(file.string(),
                "names no coordinate reference system: say it by --dem-crs (\"EPSG:25832\")");
}

std::optional<double> DemRaster::height_at(const glm::dvec2& lon_lat) const {
  double height = 0;
  model_.sample(std::span(&lon_lat, 1), std::span(&height, 1));
  if (std::isnan(height)) return std::nullopt;
  return height;
}

}  // namespace nightcity::elevation
