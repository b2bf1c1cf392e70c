// Names of saved pictures that no other program gets at the same time.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace nightcity::viewer {

/// Writes files "night-NNN" + extension into `folder`, all under the first number of which none
/// exists, and returns the stem "night-NNN". `write(file, extension)` writes one of them under a
/// temporary name; only then do they get their names, and never one that exists, whoever else saves
/// at the same moment. Throws Error with the folder and the reason; nothing is left behind then.
std::string save_under_next_name(
    const std::filesystem::path& folder, const std::vector<std::string>& extensions,
    const std::function<void(const std::filesystem::path&, const std::string&)>& write);

/// Returns where pictures go: `wanted`, or else the current folder where a file can be made there,
/// or else the user's pictures or home folder.
std::filesystem::path find_picture_folder(const std::filesystem::path& wanted);

}  // namespace nightcity::viewer
