// OSM data in JSON, as Overpass ([out:json]) and OSM's own API write it.
#pragma once

#include <cstddef>
#include <string_view>

#include "formats/scratch_file.h"
#include "tools/city/byte_source.h"

namespace nightcity::osm {

/// Returns whether a file of this beginning is OSM data in JSON.
bool begins_as_osm_json(std::string_view start);

/// JSON of more bytes is refused: it is held in memory, as XML too.
constexpr std::size_t max_map_json_bytes = std::size_t{1} << 30;

/// Writes the same data as OSM XML. Throws Error where the file cannot be read, is no JSON, or has
/// more than `max_bytes`.
void write_as_xml(const city::Document& json, ScratchFile& xml,
                  std::size_t max_bytes = max_map_json_bytes);

}  // namespace nightcity::osm
