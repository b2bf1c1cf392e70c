#include "runtime/viewer/config_folder.h"

#include <cstdlib>

namespace nightcity::viewer {

std::filesystem::path find_config_folder() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  const char* home = std::getenv("HOME");
  std::filesystem::path folder;
  if (config && *config == '/')
    folder = config;
  else if (home && *home)
    folder = std::filesystem::path(home) / ".config";
  return folder.empty() ? folder : folder / "nightcity";
}

}  // namespace nightcity::viewer
