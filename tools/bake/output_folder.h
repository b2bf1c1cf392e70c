// The folder a bake leaves its files in: all of them or none.
#pragma once

#include <filesystem>
#include <vector>

namespace nightcity {

/// Files are written into a hidden folder inside `folder` and moved out by commit(). Destroyed before that,
/// it takes away what it made, `folder` itself included where it made that too.
class OutputFolder {
 public:
  /// Makes `folder` where it is absent. Throws Error where files cannot be written into it.
  explicit OutputFolder(std::filesystem::path folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where to write the file that will be called `name`.
  std::filesystem::path staged(const char* name);
  void commit();

 private:
  std::filesystem::path folder_, staging_,
      made_;  // made_: the topmost folder that did not exist before
  std::vector<std::filesystem::path> names_;
};

}  // namespace nightcity
