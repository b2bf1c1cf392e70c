// Reads the hierarchies that a scene file holds (SPEC.md, 2.6).
#pragma once

#include <string>
#include <vector>

#include "formats/gltf_accessor.h"
#include "formats/gltf_document.h"
#include "formats/stored_hierarchy.h"

namespace nightcity {

/// Returns the hierarchies of a file, none where it has none. A scene is complete without them: if
/// one is not as SPEC.md has it, `sentences` gets one that says so, and none is returned.
std::vector<StoredHierarchy> read_hierarchies(const gltf::Document& document,
                                              const gltf::AccessorReader& accessors,
                                              std::vector<std::string>& sentences);

}  // namespace nightcity
