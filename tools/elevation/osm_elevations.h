// Writes heights into a copy of an OSM file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>

namespace nightcity::elevation {

/// Copies an OSM file of any kind that read_osm reads, and adds or replaces the tag `ele` (metres,
/// two decimals) on the nodes of `heights`. The names of the files (.osm, .osm.pbf, .osm.gz,
/// .osm.bz2) decide their kinds. XML to XML keeps everything else unchanged (comments, editors'
/// marks); other kinds keep every element with its tags and history. Returns how many nodes were
/// given a height. Throws Error: broken input, an output that cannot be written or has no OSM
/// file's name.
std::size_t write_elevations(const std::filesystem::path& input,
                             const std::filesystem::path& output,
                             const std::map<std::int64_t, double>& heights);

}  // namespace nightcity::elevation
