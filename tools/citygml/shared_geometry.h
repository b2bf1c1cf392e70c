// Geometry that members refer to across the file.
#pragma once

#include <string>
#include <unordered_set>

#include "tools/citygml/byte_source.h"
#include "tools/citygml/xlinks.h"

namespace nightcity {

/// Reads the document for the geometry with these ids (and what that refers to in turn). Ids it does not
/// hold, and those beyond the few million vertices kept at most, are not in the library.
GeometryLibrary fetch_geometry(const Document& document, std::unordered_set<std::string> wanted);

}  // namespace nightcity
