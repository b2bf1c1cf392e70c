#include "tools/bake/output_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "formats/error.h"

namespace nightcity {

namespace fs = std::filesystem;

OutputFolder::OutputFolder(fs::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  if (folder_.empty()) folder_ = ".";
  folder_ = fs::absolute(folder_).lexically_normal();
  if (!folder_.has_filename()) folder_ = folder_.parent_path();
  for (fs::path level = folder_; !fs::exists(level, error) && level.has_relative_path();
       level = level.parent_path())
    made_ = level;
  fs::create_directories(folder_, error);
  if (error || !fs::is_directory(folder_)) {
    if (!made_.empty()) fs::remove_all(made_, error);
    throw Error(folder_.string(), error ? "cannot be made: " + error.message() : "is no folder");
  }
  std::string name = (folder_ / ".nightbake-XXXXXX").string();
  if (!::mkdtemp(name.data())) {
    const std::string reason = std::strerror(errno);
    if (!made_.empty()) fs::remove_all(made_, error);
    throw Error(folder_.string(), "cannot be written into: " + reason);
  }
  staging_ = name;
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  fs::remove_all(made_.empty() ? staging_ : made_, ignored);
}

fs::path OutputFolder::staged(const char* name) {
  names_.emplace_back(name);
  return staging_ / name;
}

void OutputFolder::commit() {
  std::error_code error;
  // Every target is checked before the first is replaced: a folder in the way must not leave half a scene.
  for (const fs::path& name : names_)
    if (fs::is_directory(folder_ / name, error))
      throw Error((folder_ / name).string(), "cannot be written: it is a folder");
  for (const fs::path& name : names_) {
    fs::rename(staging_ / name, folder_ / name, error);
    if (error) throw Error((folder_ / name).string(), "cannot be written: " + error.message());
  }
  made_.clear();
}

}  // namespace nightcity
