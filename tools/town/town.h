// A synthetic European town: CityGML 2.0 LoD2, an OSM extract and the recipe that bakes them. It is the
// default scene of the demo and, being written block by block in constant memory, the load generator of the
// benchmarks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>

namespace nightcity::town {

struct TownOptions {
  std::uint64_t seed = 1;
  int columns = 8, rows = 7;  // blocks east-west and north-south
  double hills_m = 12;        // valley to hilltop
  std::size_t lamps = 0;      // luminaires in all, exactly; 0 = as many as the streets ask for
  double origin_east_m = 412000, origin_north_m = 5762000;  // of the market square, EPSG:25833
};

/// What a town holds; triangles counted as fans and holes bridged, which is what a triangulator makes of
/// them.
struct TownCounts {
  std::size_t blocks = 0, buildings = 0, polygons = 0, triangles = 0, lamps = 0, streets = 0,
              trees = 0;
};

/// Blocks needed for about this many buildings or triangles, as nearly square as the default town.
void size_for_buildings(TownOptions& options, std::size_t buildings);
void size_for_triangles(TownOptions& options, std::size_t triangles);
void size_for_blocks(TownOptions& options, std::size_t blocks);

/// Writes town.gml, town.osm and town.toml into `folder` (made when absent), each beside and then renamed.
/// Throws UsageError for sizes beyond the CRS, Error when a file cannot be written.
TownCounts write_town(const TownOptions& options, const std::filesystem::path& folder);

}  // namespace nightcity::town
