// A file mapped into memory, to be read.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "formats/signals.h"

namespace nightcity {

/// Pages are read from the disk when they are accessed, so opening takes the same time at any size.
/// If another program shortens the file meanwhile, install_signal_handlers() makes that an error
/// message.
class MappedFile {
 public:
  /// Throws Error if the file is missing, a folder, a FIFO, a device or unreadable. An empty file
  /// gives an empty span.
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;

  std::span<const std::byte> bytes() const { return bytes_; }
  /// Gives the memory of the pages read so far back to the system. They are read again when they
  /// are accessed again, so any thread may be reading them now.
  void release_pages() const;

 private:
  std::span<const std::byte> bytes_;
  MappedRange range_;
};

}  // namespace nightcity
