// Heights written back into an OSM file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>

namespace nightcity {

/// Copies an OSM file of any kind read_osm reads, with the tag `ele` (metres, two decimals) on the nodes of
/// `heights`, new or replaced. XML to XML keeps everything else as it stands (comments, editors' marks);
/// other kinds, by the names of the files (.osm, .osm.pbf, .osm.gz, .osm.bz2), keep every element with its
/// tags and history. Returns how many nodes were given a height. Throws Error: broken input, an output that
/// cannot be written or is named like no OSM file.
std::size_t write_elevations(const std::filesystem::path& input,
                             const std::filesystem::path& output,
                             const std::map<std::int64_t, double>& heights);

}  // namespace nightcity
