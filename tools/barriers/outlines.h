// Barriers that a map has as multipolygons.
#pragma once

#include <cstddef>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tools/osm/osm_data.h"

namespace nightcity::barriers {

/// Returns a closed way for each ring of the multipolygons of a map that have barrier=*, with their
/// tags and the very bits of longitude and latitude that read_osm gives nodes. `known`: ids of
/// those that another map had, to which these are added. Of more than `max_nodes` nodes none is
/// returned. Throws Error: missing or broken.
std::vector<osm::OsmWay> read_outlines(const std::filesystem::path& map, std::size_t max_nodes,
                                       std::set<std::string>& known);

}  // namespace nightcity::barriers
