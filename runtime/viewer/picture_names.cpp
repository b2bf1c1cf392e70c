#include "runtime/viewer/picture_names.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "formats/error.h"

namespace nightcity::viewer {
namespace {

namespace fs = std::filesystem;

constexpr int max_number = 999'999;

// Removes the temporary files unless they got their names.
struct Temporaries {
  std::vector<fs::path> files;
  ~Temporaries() {
    for (const fs::path& file : files) {
      std::error_code ignored;
      fs::remove(file, ignored);
    }
  }
};

// Gives `from` the name `to` unless that exists. Returns false if it does.
bool rename_if_free(const fs::path& from, const fs::path& to) {
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return true;
  if (errno == EEXIST) return false;
  const int reason = errno;
  // A file system without that call has links, which do not replace either.
  if (reason == EINVAL || reason == ENOSYS) {
    if (::link(from.c_str(), to.c_str()) == 0) {
      ::unlink(from.c_str());
      return true;
    }
    if (errno == EEXIST) return false;
  }
  throw Error(to.string(), std::string("cannot be written: ") + std::strerror(reason));
}

bool is_taken(const fs::path& file) {
  struct stat status {};
  // A link that leads nowhere is a name that is taken, too.
  if (::lstat(file.c_str(), &status) == 0) return true;
  if (errno == ENOENT) return false;
  throw Error(file.string(), std::string("cannot be written: ") + std::strerror(errno));
}

}  // namespace

std::string save_under_next_name(
    const fs::path& folder, const std::vector<std::string>& extensions,
    const std::function<void(const fs::path&, const std::string&)>& write) {
  Temporaries temporary;
  for (const std::string& extension : extensions) {
    temporary.files.push_back(folder / fmt::format(".night-{}{}", ::getpid(), extension));
    write(temporary.files.back(), extension);
  }
  for (int number = 1; number <= max_number; ++number) {
    const std::string stem = fmt::format("night-{:03}", number);
    bool taken = false;
    for (const std::string& extension : extensions) taken |= is_taken(folder / (stem + extension));
    if (taken) continue;
    std::size_t named = 0;
    while (named < extensions.size() &&
           rename_if_free(temporary.files[named], folder / (stem + extensions[named])))
      ++named;
    if (named == extensions.size()) return stem;
    // Another program was faster with one of the names: give the others back and try the next.
    while (named-- > 0) fs::rename(folder / (stem + extensions[named]), temporary.files[named]);
  }
  throw Error(folder.string(), "holds a picture of every number");
}

fs::path find_picture_folder(const fs::path& wanted) {
  if (!wanted.empty()) return wanted;
  const auto usable = [](const fs::path& folder) {
    return ::access(folder.c_str(), W_OK | X_OK) == 0;
  };
  if (usable(".")) return ".";
  if (const char* home = std::getenv("HOME"); home && *home)
    for (const fs::path& folder : {fs::path(home) / "Pictures", fs::path(home)})
      if (usable(folder)) return folder;
  return ".";
}

}  // namespace nightcity::viewer
