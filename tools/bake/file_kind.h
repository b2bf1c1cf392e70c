// What kind of file a path names, by what is in it.
#pragma once

#include <filesystem>

namespace nightcity {

enum class FileKind { citygml, osm, scene, lights, luminaire };

/// Looks at the first bytes; only compressed files are told apart by name. Throws Error: missing, empty, a
/// folder, or of none of these kinds.
FileKind file_kind(const std::filesystem::path& path);

}  // namespace nightcity
