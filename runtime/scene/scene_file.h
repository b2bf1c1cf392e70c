// The scene that a path of the command line, or one dropped on the window, stands for.
#pragma once

#include <filesystem>
#include <string>

namespace nightcity::scene {

/// Returns whether a name ends as a scene's, its lights' or a folder's may: .glb, .gltf or .lights
/// in any case, or an existing folder.
bool may_be_scene(const std::filesystem::path& path);

/// Returns the scene's file: that of a folder is its city.glb, or else its only .glb; that of a
/// light file is the .glb beside it. Other paths are returned as they are. Throws Error where a
/// folder holds no scene or several.
std::filesystem::path find_scene_file(const std::filesystem::path& path);

}  // namespace nightcity::scene
