// A whole file as read-only memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "formats/signals.h"

namespace nightcity {

/// Pages come from the disk as they are touched, so opening takes the same time at any size. Where
/// another program cuts the file short meanwhile, install_signal_handlers() makes that a message.
class MappedFile {
 public:
  /// Throws Error: missing, a folder, a FIFO or device, unreadable. An empty file gives an empty
  /// span.
  explicit MappedFile(const std::filesystem::path& path);
  ~MappedFile();
  MappedFile(MappedFile&& other) noexcept;
  MappedFile& operator=(MappedFile&& other) noexcept;

  std::span<const std::byte> bytes() const { return bytes_; }

 private:
  std::span<const std::byte> bytes_;
  MappedRange range_;
};

}  // namespace nightcity
