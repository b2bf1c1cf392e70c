// Files that are unpacked for GDAL, without names on the disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "formats/scratch_file.h"

namespace nightcity::gdal {

/// Files that GDAL opens by names which no disk has ("/vsinightcity/3/tiles/a.tif") and finds those
/// that belong to them beside: a .tfw, a .prj. Their bytes lie one behind the other in one file
/// without a name, so that nothing is left behind however the program ends, and a thousand take one
/// descriptor. They go with this object, so what GDAL has opened of them has to be closed before.
class ScratchFiles {
 public:
  /// Reads up to so many bytes and returns how many; 0 at the end.
  using ReadBytes = std::function<std::size_t(char*, std::size_t)>;

  /// `folder`: where the bytes lie (scratch_folder()).
  explicit ScratchFiles(const std::filesystem::path& folder);
  ~ScratchFiles();
  ScratchFiles(const ScratchFiles&) = delete;
  ScratchFiles& operator=(const ScratchFiles&) = delete;

  /// Adds a file and returns the name by which GDAL opens it. Folders in `name` are kept; none
  /// leads anywhere. Throws Error where the disk is full, and what `read` throws.
  std::string add(std::string_view name, const ReadBytes& read);

 private:
  std::string folder_;
  std::shared_ptr<ScratchFile> bytes_;
};

/// Lets GDAL find such files. Called once, before any is opened.
void install_scratch_files();

}  // namespace nightcity::gdal
