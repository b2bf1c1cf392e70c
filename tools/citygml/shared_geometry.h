// Geometry that members refer to across the file.
#pragma once

#include <string>
#include <unordered_set>

#include "tools/city/byte_source.h"
#include "tools/citygml/xlinks.h"

namespace nightcity::citygml {

/// The most vertices kept of the geometry that one document's links lead to: 200 MB.
constexpr std::size_t max_shared_vertices = 8'000'000;

/// Reads the document for the geometry with these ids and for the geometry that it refers to in
/// turn. The library lacks ids that the document does not hold and those that would take more than
/// `room` vertices; its vertices are subtracted from `room`.
GeometryLibrary fetch_geometry(const city::Document& document,
                               std::unordered_set<std::string> wanted, std::size_t& room);

}  // namespace nightcity::citygml
