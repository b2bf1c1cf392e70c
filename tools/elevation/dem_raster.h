// Heights from a raster (GeoTIFF, ASCII grid, any that GDAL reads) for places where the model has
// no ground.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tools/terrain/open_models.h"

namespace nightcity::elevation {

class DemRaster {
 public:
  /// Opens the first bands of the rasters in a file, an archive or a folder, metres. Throws Error
  /// as open_elevation_models does, and where one has no CRS.
  explicit DemRaster(const std::filesystem::path& file,
                     const terrain::ElevationOptions& options = {});

  /// Returns the height at WGS 84 degrees, bilinear between the centres of cells, by the finest
  /// raster that has one; none outside of all and beside a cell without data. Throws Error where a
  /// raster cannot be read.
  std::optional<double> height_at(const glm::dvec2& lon_lat) const;

 private:
  std::vector<terrain::ElevationModel> models_;
};

}  // namespace nightcity::elevation
