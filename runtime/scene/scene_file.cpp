#include "runtime/scene/scene_file.h"

#include <algorithm>
#include <vector>

#include "formats/error.h"
#include "formats/to_lower.h"

namespace nightcity::scene {
namespace {

namespace fs = std::filesystem;

std::string extension_of(const fs::path& path) {
  return to_lower(path.extension().string());
}

bool is_folder(const fs::path& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

fs::path find_in_folder(const fs::path& folder) {
  std::error_code failed;
  if (fs::exists(folder / "city.glb", failed)) return folder / "city.glb";
  std::vector<fs::path> scenes;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, failed))
    if (extension_of(entry.path()) == ".glb") scenes.push_back(entry.path());
  if (failed) throw Error(folder.string(), "cannot be read: " + failed.message());
  if (scenes.size() == 1) return scenes.front();
  if (scenes.empty()) throw Error(folder.string(), "this folder holds no .glb");
  std::sort(scenes.begin(), scenes.end());
  std::string names;
  for (const fs::path& scene : scenes)
    names += (names.empty() ? "" : ", ") + scene.filename().string();
  throw Error(folder.string(), "this folder holds several scenes; name one of " + names);
}

}  // namespace

bool may_be_scene(const fs::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".glb" || extension == ".gltf" || extension == ".lights" || is_folder(path);
}

fs::path find_scene_file(const fs::path& path) {
  if (is_folder(path)) return find_in_folder(path);
  if (extension_of(path) != ".lights") return path;
  std::error_code ignored;
  for (const char* extension : {".glb", ".GLB", ".gltf"}) {
    fs::path beside = path;
    beside.replace_extension(extension);
    if (fs::exists(beside, ignored)) return beside;
  }
  throw Error(path.string(), "holds lights alone, and no .glb lies beside it");
}

}  // namespace nightcity::scene
