// OSM data in JSON, as Overpass ([out:json]) and OSM's own API write it.
#pragma once

#include <string_view>

#include "formats/scratch_file.h"
#include "tools/city/byte_source.h"

namespace nightcity::osm {

/// Returns whether a file of this beginning is OSM data in JSON.
bool begins_as_osm_json(std::string_view start);

/// Writes the same data as OSM XML. Throws Error where the file cannot be read or is no JSON.
void write_as_xml(const city::Document& json, ScratchFile& xml);

}  // namespace nightcity::osm
