// A synthetic European town: CityGML 2.0 LoD2, an OSM extract and the recipe that bakes them. It is
// the default scene of the demo. Because it is written block by block in constant memory, it also
// generates the load of the benchmarks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace nightcity::town {

struct TownOptions {
  std::uint64_t seed = 1;
  int columns = 8, rows = 7;  // blocks east-west and north-south
  double hills_m = 12;        // valley to hilltop
  std::size_t lamps = 0;      // luminaires in all, exactly; 0 = as many as the streets need
  double origin_east_m = 412000, origin_north_m = 5762000;  // of the market square, EPSG:25833
};

/// The content of a town. A polygon counts the triangles that a triangulator makes of it: a fan,
/// its holes bridged.
struct TownCounts {
  std::size_t blocks = 0, buildings = 0, polygons = 0, triangles = 0, lamps = 0, streets = 0,
              trees = 0;
};

/// Set columns and rows for about this many buildings, triangles or blocks, in the default town's
/// proportions.
void size_for_buildings(TownOptions& options, std::size_t buildings);
void size_for_triangles(TownOptions& options, std::size_t triangles);
void size_for_blocks(TownOptions& options, std::size_t blocks);

/// Writes town.gml, town.osm and town.toml into `folder` (made when absent). Each file gets its
/// name when it is complete. Throws UsageError for sizes beyond the CRS, Error when a file cannot
/// be written.
TownCounts write_town(const TownOptions& options, const std::filesystem::path& folder);

}  // namespace nightcity::town
