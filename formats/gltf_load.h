// A glTF file into tinygltf's model, guarded: tinygltf trusts its input more than we do.
#pragma once

#include <tiny_gltf.h>

#include <filesystem>

namespace nightcity::gltf {

/// Reads .glb or .gltf (by content, not by name) with its buffers; images stay unread. Throws Error: missing,
/// empty, truncated, not glTF, JSON nested over 256 deep, anything tinygltf refuses.
tinygltf::Model load(const std::filesystem::path& path);

}  // namespace nightcity::gltf
