// The folder that keeps what the user arranged, between two runs of the program.
#pragma once

#include <filesystem>

namespace nightcity::viewer {

/// Returns the program's folder below $XDG_CONFIG_HOME or ~/.config, which may not exist yet; ""
/// without a home (XDG Base Directory Specification).
std::filesystem::path find_config_folder();

}  // namespace nightcity::viewer
