// Rasters in archives and streams (gzip, xz, ...).
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tools/city/byte_source.h"
#include "tools/gdal/scratch_files.h"
#include "tools/terrain/elevation_model.h"

namespace nightcity::terrain {

/// Unpacks rasters, and what belongs to them, to where GDAL finds them; there go texts that it
/// misreads, in a form that it reads.
class RasterUnpacker {
 public:
  /// `max_mb`: of all that is unpacked.
  explicit RasterUnpacker(int max_mb) : max_mb_(max_mb) {}

  /// Returns the rasters in a file: itself where it is not packed. Throws Error: an archive without
  /// a raster, broken, encrypted, or too large unpacked.
  std::vector<RasterFile> find_rasters(const std::filesystem::path& file);

 private:
  struct Entry {
    std::string name;    // for messages
    std::string inside;  // its path in the archive
    std::function<std::unique_ptr<city::ByteSource>()> open;
  };

  std::vector<RasterFile> unpack_archive(const std::string& path,
                                         const city::FileContents& contents);
  /// Throws Error where two have one name.
  std::vector<RasterFile> copy_rasters(const std::vector<const Entry*>& rasters);
  /// Unpacks, or puts into another form, a file that is one raster, with what lies beside it.
  RasterFile copy_alone(const std::filesystem::path& file, const city::Document& document);
  /// Writes an elevation model of GSI as another raster.
  std::string copy_gsi_grid(const Entry& entry);
  /// Returns the path by which GDAL finds an entry.
  std::string copy(const Entry& entry);
  std::string add(const std::string& inside, const std::string& name, city::ByteSource& source);
  void count(std::size_t bytes, const std::string& name);

  int max_mb_;
  std::uint64_t unpacked_ = 0;
  std::size_t inputs_ = 0;  // each has a folder of its own
  std::shared_ptr<gdal::ScratchFiles> files_;
};

/// Returns whether a file is an archive, or a stream, in which a name ends as a raster's.
bool holds_packed_rasters(const std::filesystem::path& file);

}  // namespace nightcity::terrain
