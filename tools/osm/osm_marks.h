// Recognises OSM data, and what people take for it, by the first bytes of a file.
#pragma once

#include <string>
#include <string_view>

namespace nightcity::osm {

bool is_osm_pbf(std::string_view start);
bool is_o5m(std::string_view start);
/// Plain XML, in UTF-8 or UTF-16.
bool is_xml(std::string_view start);
bool is_bzip2(std::string_view start);

/// Returns what a file with these first bytes is, and what to do about it, if it is related to OSM
/// or packed in a way that is not read here: OPL, o5c, a change file, an answer of Overpass in JSON
/// or CSV, a web page, xz, zstd, lz4, 7z, rar or tar. Empty otherwise.
std::string describe_unread_osm(std::string_view start);

}  // namespace nightcity::osm
