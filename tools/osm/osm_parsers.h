// The two parsers behind read_osm.
#pragma once

#include <filesystem>
#include <string>

#include "tools/osm/osm_collector.h"

namespace nightcity::osm {

/// Reads plain OSM XML by pugixml. Throws Error: broken XML (with its line), a DOCTYPE, another
/// root than <osm>, or a remark of the server that the answer is incomplete.
void read_osm_xml(const std::filesystem::path& file, OsmCollector& collector);

/// Reads by libosmium. `format`: its name for it, "pbf", "osm.gz", "osm.bz2" or "o5m". Throws
/// Error.
void read_osm_packed(const std::filesystem::path& file, const std::string& format,
                     OsmCollector& collector);

}  // namespace nightcity::osm
