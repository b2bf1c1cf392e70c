#include "formats/program/output.h"

#include <unistd.h>

#include <algorithm>
#include <system_error>
#include <vector>

#include "formats/error.h"
#include "formats/signals.h"

namespace nightcity::program {
namespace {

struct MadeFolder {
  std::filesystem::path path;
  Leftover leftover;
};

// The folders are the whole program's, because the command that makes one is not the one that
// learns of a failure.
std::vector<MadeFolder>& made_folders() {
  static std::vector<MadeFolder> folders;
  return folders;
}

void make_folders(const std::filesystem::path& folder) {
  std::error_code error;
  std::vector<std::filesystem::path> missing;
  for (std::filesystem::path path = std::filesystem::absolute(folder, error);
       path.has_relative_path() && !std::filesystem::exists(path, error); path = path.parent_path())
    missing.push_back(path);
  std::for_each(missing.rbegin(), missing.rend(), [&](const std::filesystem::path& path) {
    const SignalHold until_registered;
    if (std::filesystem::create_directory(path, error))
      made_folders().push_back({path, Leftover(path, Leftover::Kind::folder)});
  });
}

// Removes the folders made since there were `count`, the last first, where they are empty.
void remove_made_beyond(std::size_t count) {
  std::error_code ignored;
  for (; made_folders().size() > count; made_folders().pop_back())
    if (std::filesystem::is_directory(made_folders().back().path, ignored))
      ::rmdir(made_folders().back().path.c_str());
}

}  // namespace

void require_writable_folder(const std::filesystem::path& folder) {
  const std::size_t before = made_folders().size();
  make_folders(folder);  // the next line finds a failure
  std::error_code error;
  if (std::filesystem::is_directory(folder, error) && ::access(folder.c_str(), W_OK | X_OK) == 0)
    return;
  remove_made_beyond(before);
  throw Error(folder.string(), "is not a folder that can be written to");
}

void remove_made_folders() {
  remove_made_beyond(0);
}

void keep_made_folders() {
  made_folders().clear();
}

void require_writable_folder_of(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    throw Error(file.string(), "is a folder: name a file in it");
  // Nothing is made beside a device or FIFO (/dev/null, /dev/stdout).
  if (std::filesystem::exists(file, ignored) && !std::filesystem::is_regular_file(file, ignored))
    return;
  require_writable_folder(std::filesystem::absolute(file).parent_path());
}

}  // namespace nightcity::program
