#include "formats/program/output.h"

#include <unistd.h>

#include <system_error>

#include "formats/error.h"

namespace nightcity::program {

void require_writable_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);  // the next line finds a failure
  if (!std::filesystem::is_directory(folder, error) || ::access(folder.c_str(), W_OK | X_OK) != 0)
    throw Error(folder.string(), "is not a folder that can be written to");
}

void require_writable_folder_of(const std::filesystem::path& file) {
  // Nothing is made beside a device or FIFO (/dev/null, /dev/stdout).
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored) && !std::filesystem::is_regular_file(file, ignored) &&
      !std::filesystem::is_directory(file, ignored))
    return;
  require_writable_folder(std::filesystem::absolute(file).parent_path());
}

}  // namespace nightcity::program
