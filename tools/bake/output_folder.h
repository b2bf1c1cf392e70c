// The folder a bake leaves its files in: all of them or none.
#pragma once

#include <filesystem>
#include <vector>

#include "formats/signals.h"

namespace nightcity::bake {

/// Files are written into a hidden folder ".nightbake-XXXXXX" inside `folder` and moved out by
/// commit(). Destroyed before that, or ended by a signal that can be caught, it takes away what it
/// made: the hidden folder, and those of `folder` and its parents that it made and that are still
/// empty.
///
/// At each moment, also when the program is killed or the power fails, the first file staged is
/// absent from `folder` or all files there are of the same bake: commit() takes the old first file
/// away before it touches another, and the new first file appears last. What a killed program
/// leaves is removed by the next OutputFolder of the same folder; where it was killed amid
/// commit(), that is finished first.
///
/// A name in `folder` that is a symbolic link, a device or a FIFO is written as AtomicFile does, by
/// itself.
class OutputFolder {
 public:
  /// Makes `folder` where it is absent. Throws Error where files cannot be written into it.
  explicit OutputFolder(std::filesystem::path folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Returns where to write the file that will be called `name`, which may lie in a folder of its
  /// own ("tiles/1.glb").
  std::filesystem::path staged(const std::filesystem::path& name);
  void commit();

 private:
  void make_folder();
  void make_staging();
  void remove_made() noexcept;

  std::filesystem::path folder_, staging_;
  /// The levels of `folder_` that did not exist before, topmost first.
  std::vector<std::filesystem::path> made_;
  std::vector<Leftover> leftovers_;
  std::vector<std::filesystem::path> names_;
  /// Locked while this bake lives, so that another knows the hidden folder from one that was left
  /// behind.
  int lock_ = -1;
};

}  // namespace nightcity::bake
