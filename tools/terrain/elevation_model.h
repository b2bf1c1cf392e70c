// A digital elevation model: a raster of heights in any format and CRS that GDAL reads.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <limits>
#include <memory>
#include <span>
#include <string>

#include "formats/error.h"

namespace nightcity::gdal {
class ScratchFiles;
}

namespace nightcity::terrain {

/// Millions of pixels. Blocks of rasters are tiles of 256 to 1024 pixels a side, or some rows.
constexpr int default_max_block_mpx = 64;

/// Thrown where no driver takes a file as a raster.
struct NoRaster : Error {
  using Error::Error;
};

/// A raster as GDAL opens it.
struct RasterFile {
  std::string path;  // as GDAL takes it
  std::string name;  // for messages; of an archive's entry with the archive's path before it
  std::shared_ptr<const gdal::ScratchFiles> unpacked;  // that `path` is one of; null: of the disk
};

/// A height (m; NaN: none) and how much it counts beside those of other models.
struct HeightSample {
  double height = std::numeric_limits<double>::quiet_NaN();
  double weight = 0;    // 1 between the outermost centres of pixels, 0 one pixel beyond them
  bool inside = false;  // of the raster, which reaches half a pixel beyond them
};

class ElevationModel {
 public:
  /// Opens band 1 of the raster. Throws Error: missing, no raster, no place on earth (no
  /// geotransform), a picture in colours, heights in a unit that is not known, blocks of more than
  /// `max_block_mpx` million pixels. A raster is read in windows, so that its own size costs
  /// nothing, but GDAL unpacks blocks as a whole. `crs_without`: the CRS of a raster that names
  /// none; "": it stays without.
  explicit ElevationModel(const std::filesystem::path& file,
                          int max_block_mpx = default_max_block_mpx,
                          const std::string& crs_without = {});
  /// `like`: a model that may have the same CRS, as the tile before has; null: none.
  explicit ElevationModel(const RasterFile& file, int max_block_mpx, const std::string& crs_without,
                          const ElevationModel* like = nullptr);
  ~ElevationModel();
  ElevationModel(ElevationModel&&) noexcept;
  ElevationModel& operator=(ElevationModel&&) noexcept;

  /// Returns the name of the raster, for messages.
  const std::string& name() const;
  /// Returns whether the raster names a CRS. Without one, its coordinates are taken to be the
  /// caller's.
  bool has_crs() const;
  /// Returns its name where it has one in a register: "EPSG:25833"; else "".
  const std::string& crs() const;
  /// Returns what is assumed about the heights and may be wrong, for a report: that they are metres
  /// where the CRS counts feet in the plan and names no unit of heights, or where pixels are bytes,
  /// as pictures have them. Else "".
  const std::string& assumption() const;
  /// Returns the distance of neighbouring heights, m (north-south, for a raster in degrees).
  double resolution_m() const;

  /// Fills `heights` with metres (the band's unit, else that of the vertical CRS, and the band's
  /// scale and offset applied), bilinear between the pixels' centres; NaN outside the raster and
  /// beside pixels without data, as a no-data value, a mask or an alpha band say. Longitudes may
  /// run from -180 or from 0 in the raster. `places`: WGS 84 longitude, latitude where has_crs(),
  /// else the raster's own x, y. Reads the part of the raster between the places, so ask for places
  /// that lie together. Throws Error when the raster cannot be read.
  void sample(std::span<const glm::dvec2> places, std::span<double> heights) const;
  /// The same, also up to one pixel beyond the outermost centres, with the nearest of these places'
  /// height. Tiles that lie side by side, each by its weight, give what one raster gives.
  void sample_beyond(std::span<const glm::dvec2> places, std::span<HeightSample> samples) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nightcity::terrain
