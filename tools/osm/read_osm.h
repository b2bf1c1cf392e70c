// OpenStreetMap extracts.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "tools/osm/osm_data.h"

namespace nightcity::osm {

/// Returns whether a file with these first bytes is an extract: XML, PBF, o5m or JSON. The bytes of
/// a packed file are those of its content.
bool begins_as_osm(std::string_view start);

/// Reads an extract or a history: XML by pugixml; PBF, o5m, gzip and bzip2 by libosmium. The first
/// bytes decide, not the name. Throws Error: missing, broken, not OSM (then it says what the file
/// is instead, if that can be known). Streets, buildings and lamps of more than `max_way_nodes`
/// nodes are left out and counted.
OsmData read_osm(const std::filesystem::path& file,
                 std::size_t max_way_nodes = default_max_way_nodes);

/// Reads several extracts as one map, whatever their order: of an element that is in several, the
/// newest version counts.
OsmData read_osm(std::span<const std::filesystem::path> files,
                 std::size_t max_way_nodes = default_max_way_nodes);

}  // namespace nightcity::osm
