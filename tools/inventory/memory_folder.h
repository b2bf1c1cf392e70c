// Files in GDAL's memory, for tables that are not read as they lie on the disk.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace nightcity::inventory {

/// The bytes of the largest file that is read as a whole, and of the largest that is made of one.
constexpr std::size_t most_whole_bytes = std::size_t{1} << 30;

/// A folder of files that GDAL opens as it does those on a disk, under a name of its own. Its files
/// go with it, so a dataset in it has to be closed before.
class MemoryFolder {
 public:
  MemoryFolder();
  ~MemoryFolder();
  MemoryFolder(MemoryFolder&& other) noexcept;
  MemoryFolder& operator=(MemoryFolder&& other) noexcept;

  /// Adds a file and returns its path. The name is that of a file, whatever folders stand in it.
  std::string add(std::string_view name, std::string_view bytes);

 private:
  std::string folder_;
  std::vector<std::string> paths_;
};

}  // namespace nightcity::inventory
