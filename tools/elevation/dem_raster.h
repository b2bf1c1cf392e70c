// Heights out of a raster (GeoTIFF, ASCII grid, ... whatever GDAL reads), where the model has no ground.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>

namespace nightcity {

class DemRaster {
 public:
  /// The first band, metres. Throws Error: missing, no raster, no CRS or no place on the Earth.
  explicit DemRaster(const std::filesystem::path& file);
  ~DemRaster();
  DemRaster(DemRaster&&) noexcept;
  DemRaster& operator=(DemRaster&&) noexcept;

  /// Bilinear between the middles of cells; nothing outside the raster, beside a cell without data and where
  /// the cell cannot be read. WGS 84 degrees.
  std::optional<double> height_at(const glm::dvec2& lon_lat) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nightcity
