// Geometry that members refer to across the file.
#pragma once

#include <string>
#include <unordered_set>

#include "tools/city/byte_source.h"
#include "tools/citygml/xlinks.h"

namespace nightcity {

/// Vertices kept at most, of all that one document's links lead to: 200 MB.
constexpr std::size_t max_shared_vertices = 8'000'000;

/// Reads the document for the geometry with these ids (and what that refers to in turn within it). Ids it
/// does not hold, and those beyond `room` vertices, are not in the library; what is in it comes off `room`.
GeometryLibrary fetch_geometry(const city::Document& document, std::unordered_set<std::string> wanted,
                               std::size_t& room);

}  // namespace nightcity
