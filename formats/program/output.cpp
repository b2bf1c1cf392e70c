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
  require_writable_folder(std::filesystem::absolute(file).parent_path());
}

}  // namespace nightcity::program
