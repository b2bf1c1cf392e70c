// Reads scenes: city.glb, or any other glTF 2.0.
#pragma once

#include <filesystem>

#include "formats/scene.h"

namespace nightcity {

/// Returns the scene in a .glb or .gltf file, ours or anybody's: with Draco, instancing, node
/// hierarchies, indices of 8, 16 or 32 bits or none. Throws Error if the file is missing, truncated
/// or no glTF, an index is out of range, or a position or matrix is not finite.
Scene read_scene(const std::filesystem::path& path);

/// Returns where the scene in a .glb or .gltf file lies, and its identity; as read_scene, without
/// the work on meshes. Throws Error.
Georeference read_scene_georeference(const std::filesystem::path& path);

}  // namespace nightcity
