#include "formats/file_names.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <random>
#include <string>

#include "formats/error.h"

namespace nightcity {
namespace {

namespace fs = std::filesystem;

}  // namespace

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

fs::path scratch_folder() {
  const char* named = std::getenv("TMPDIR");
  const fs::path folder = named && *named ? named : "/tmp";
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored) || ::access(folder.c_str(), W_OK | X_OK) != 0)
    throw Error(folder.string(),
                "is no folder that temporary files can be written into; TMPDIR names another");
  return folder;
}

std::pair<fs::path, int> make_hidden_beside(const fs::path& path,
                                            const std::function<int(const fs::path&)>& make) {
  constexpr char letters[] = "abcdefghijklmnopqrstuvwxyz0123456789";
  constexpr std::size_t max_name = 200;  // a file name has 255 bytes
  std::random_device random;
  for (int attempt = 0; attempt < 100; ++attempt) {
    std::string name = "." + path.filename().string().substr(0, max_name) + ".";
    for (int i = 0; i < 6; ++i) name += letters[random() % (sizeof letters - 1)];
    const fs::path result = folder_of(path) / (name + ".part");
    const int made = make(result);
    if (made >= 0) return {result, made};
    if (errno != EEXIST) break;
  }
  return {fs::path(), -1};
}

std::pair<fs::path, int> open_hidden_beside(const fs::path& target) {
  return make_hidden_beside(target, [](const fs::path& name) {
    return ::open(name.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, file_mode);
  });
}

void sync_folder(const fs::path& folder) noexcept {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace nightcity
