// Reads a CityJSONSeq: a line of what its features have in common, then a feature a line.
#pragma once

#include "tools/city/byte_source.h"
#include "tools/city/city_reader.h"

namespace nightcity::cityjson {

/// Streams the features, in memory that does not grow with the document. Throws Error with the
/// line.
city::ReadReport read_sequence(const city::Document& document, const city::ReadOptions& options,
                               const city::ObjectStage& stage);

/// Returns CRS and first vertices.
city::CityHead read_sequence_head(const city::Document& document, const city::ReadOptions& options);

}  // namespace nightcity::cityjson
