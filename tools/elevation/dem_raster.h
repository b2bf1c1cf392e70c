// Heights out of a raster (GeoTIFF, ASCII grid, ... whatever GDAL reads), where the model has no ground.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <optional>

#include "tools/terrain/elevation_model.h"

namespace nightcity {

class DemRaster {
 public:
  /// The first band, metres. Throws Error: missing, no raster, no CRS or no place on the Earth.
  explicit DemRaster(const std::filesystem::path& file);

  /// Bilinear between the middles of cells; nothing outside the raster and beside a cell without data. WGS 84
  /// degrees. Throws Error where the raster cannot be read.
  std::optional<double> height_at(const glm::dvec2& lon_lat) const;

 private:
  ElevationModel model_;
};

}  // namespace nightcity
