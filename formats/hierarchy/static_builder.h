// Builds the hierarchies of a scene's static triangles, as nightview does where a file has none.
#pragma once

#include <filesystem>
#include <vector>

#include "formats/hierarchy/topology.h"
#include "formats/stored_hierarchy.h"

namespace nightcity::hierarchy {

/// A hierarchy with its numbers, which `description` points into.
struct BuiltHierarchy {
  StoredHierarchy description;
  Encoded encoded;
};

/// Returns the hierarchies of a scene file's static triangles: what casts shadows, and the rest,
/// without those that would be empty; none where there are more than 134 million triangles. Their
/// boxes lie along most of the walls (box_frame.h). `has_traffic`: bodies of vehicles are not static
/// then. The result does not depend on the number of threads. Throws Error where the file cannot be
/// read.
std::vector<BuiltHierarchy> build_static_hierarchies(const std::filesystem::path& glb,
                                                     bool has_traffic, unsigned threads);

}  // namespace nightcity::hierarchy
