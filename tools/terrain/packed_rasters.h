// Rasters in archives and gzip streams.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tools/city/byte_source.h"
#include "tools/terrain/elevation_model.h"

namespace nightcity::terrain {

/// Unpacks rasters, and what belongs to them, to where GDAL finds them.
class RasterUnpacker {
 public:
  /// `max_mb`: of all that is unpacked.
  explicit RasterUnpacker(int max_mb) : max_mb_(max_mb) {}

  /// Returns the rasters in a file: itself where it is not packed. Throws Error: an archive without
  /// a raster, broken, encrypted, or too large unpacked.
  std::vector<RasterFile> find_rasters(const std::filesystem::path& file);

 private:
  std::vector<RasterFile> unpack_archive(const std::string& path,
                                         const city::FileContents& contents);
  RasterFile unpack_gzip(const std::filesystem::path& file, const city::Document& document);
  /// Returns the path by which GDAL finds the document under this name.
  std::string unpack(const city::Document& document, const std::string& name);
  std::string unpack_gzip_in_archive(const city::Document& document, const std::string& name);
  void count(std::size_t bytes, const std::string& name);

  int max_mb_;
  std::uint64_t unpacked_ = 0;
  std::size_t inputs_ = 0;  // each has a folder of its own
  std::shared_ptr<gdal::ScratchFiles> files_;
};

/// Returns whether a file is an archive, or a gzip stream, in which a name ends as a raster's.
bool holds_packed_rasters(const std::filesystem::path& file);

}  // namespace nightcity::terrain
