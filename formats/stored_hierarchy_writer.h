// Writes hierarchies into a scene file that is complete without them (SPEC.md, 2.6).
#pragma once

#include <filesystem>
#include <span>

#include "formats/stored_hierarchy.h"

namespace nightcity {

/// Replaces `glb`, a .glb with one buffer, by the same scene with these hierarchies, at least one.
/// Those that it had are forgotten, but their bytes stay. Returns false, and leaves the file as it
/// is, where it would become larger than the 4 GiB that a .glb may hold. Throws Error.
bool store_hierarchies(const std::filesystem::path& glb,
                       std::span<const StoredHierarchy> hierarchies);

}  // namespace nightcity
