// Checks that a path may be opened for reading.
#pragma once

#include <filesystem>

#include "formats/error.h"

namespace nightcity {

/// Throws Error where `path` is a FIFO, a socket or a device: to open or read one may wait for
/// ever. What is absent or a folder is left to whoever opens it.
inline void refuse_special_file(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_other(status) || std::filesystem::is_fifo(status) ||
      std::filesystem::is_socket(status) || std::filesystem::is_character_file(status) ||
      std::filesystem::is_block_file(status))
    throw Error(path.string(), "is not a regular file");
}

}  // namespace nightcity
