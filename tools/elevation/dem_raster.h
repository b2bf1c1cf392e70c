// Heights from a raster (GeoTIFF, ASCII grid, any that GDAL reads) for places where the model has
// no ground.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>

#include "tools/terrain/elevation_model.h"

namespace nightcity::elevation {

class DemRaster {
 public:
  /// Opens the raster's first band, metres. Throws Error: missing, no raster, no CRS, no place on
  /// the Earth, or blocks of more than `max_block_mpx` million pixels. `crs_without`: the CRS of a
  /// raster that names none.
  explicit DemRaster(const std::filesystem::path& file,
                     int max_block_mpx = terrain::default_max_block_mpx,
                     const std::string& crs_without = {});

  /// Returns the height at WGS 84 degrees, bilinear between the centres of cells; none outside the
  /// raster and beside a cell without data. Throws Error where the raster cannot be read.
  std::optional<double> height_at(const glm::dvec2& lon_lat) const;

 private:
  terrain::ElevationModel model_;
};

}  // namespace nightcity::elevation
