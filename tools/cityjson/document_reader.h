// Reads a CityJSON: one JSON object with all city objects and the vertices that they share.
#pragma once

#include <string>
#include <string_view>

#include "tools/city/city_reader.h"

namespace nightcity::cityjson {

/// Beside the text, memory holds its vertices (24 bytes each) and where each city object stands.
/// Throws Error with file and line.
city::ReadReport read_document(std::string_view text, const std::string& name,
                               const city::ReadOptions& options, const city::ObjectStage& stage);

/// Returns CRS and first vertices.
city::CityHead read_document_head(std::string_view text, const std::string& name,
                                  const city::ReadOptions& options);

}  // namespace nightcity::cityjson
