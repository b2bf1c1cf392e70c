// Geometry that members refer to across the file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "tools/city/byte_source.h"
#include "tools/city/city_reader.h"
#include "tools/citygml/xlinks.h"

namespace nightcity::citygml {

struct FetchedGeometry {
  std::unordered_map<std::string, std::vector<LinkedPolygon>> polygons;  // by id
  std::size_t beyond_room = 0;  // ids whose geometry had no room
};

/// Reads the document for the geometry with these ids and for the geometry that it refers to in
/// turn. The result lacks ids that the document does not hold and those that would take more than
/// `room` vertices; its vertices are subtracted from `room`. Polygons are numbered from `next` on.
/// `document_srs_name`: of the document's own extent.
FetchedGeometry fetch_geometry(const city::Document& document,
                               std::unordered_set<std::string> wanted,
                               const city::ReadOptions& options,
                               const std::string& document_srs_name, std::uint64_t& next,
                               std::size_t& room);

}  // namespace nightcity::citygml
