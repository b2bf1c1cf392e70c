// A digital elevation model: a raster of heights in any format and CRS that GDAL reads.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <memory>
#include <span>

namespace nightcity {

class ElevationModel {
 public:
  /// Opens band 1 of the raster. Throws Error: missing, no raster, no place on earth (no geotransform).
  explicit ElevationModel(const std::filesystem::path& file);
  ~ElevationModel();
  ElevationModel(ElevationModel&&) noexcept;

  /// False: the raster names no CRS, and its coordinates are taken to be the asker's.
  bool has_crs() const;
  /// Distance of neighbouring heights, m (north-south, for a raster in degrees).
  double resolution_m() const;

  /// Heights in metres, bilinear between the pixels' centres; NaN outside the raster and beside pixels
  /// without data. `places`: WGS 84 longitude, latitude where has_crs(), else the raster's own x, y. Only
  /// what lies among the places is read, so ask for places that lie together. Throws Error when the raster
  /// cannot be read.
  void sample(std::span<const glm::dvec2> places, std::span<double> heights) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nightcity
