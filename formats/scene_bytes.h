// The memory that a scene's arrays lie in.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "formats/mapped_file.h"

namespace nightcity {

/// The files of a scene, and the data URIs in them.
struct SceneBytes {
  std::deque<MappedFile> files;
  std::deque<std::vector<std::byte>> decoded;

  /// Gives the memory of the mapped files back to the system, which reads them again when they are
  /// accessed again. Other threads may be reading them.
  void release_pages() const {
    for (const MappedFile& file : files) file.release_pages();
  }
};

}  // namespace nightcity
