#include "tools/bake/city/map_reach.h"

#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "formats/finite.h"

namespace nightcity::bake {
namespace {

terrain::Extent empty_extent() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {glm::dvec2(infinity), glm::dvec2(-infinity)};
}

void widen(terrain::Extent& extent, const glm::dvec2& place) {
  extent.low = glm::min(extent.low, place);
  extent.high = glm::max(extent.high, place);
}

}  // namespace

std::vector<glm::dvec2> find_map_places(const osm::OsmData& map, const CoverOptions& options,
                                        const place::LonLatToFrame& to_frame) {
  std::vector<glm::dvec2> places;
  const auto add = [&](const glm::dvec2& lon_lat) {
    if (const glm::dvec2 place = to_frame(lon_lat); finite(place)) places.push_back(place);
  };
  const auto add_ways = [&](const std::vector<osm::OsmWay>& ways) {
    for (const osm::OsmWay& way : ways)
      for (const glm::dvec2& p : way.lon_lat) add(p);
  };
  if (options.streets) add_ways(map.highways);
  if (options.rails) add_ways(map.railways);
  if (options.trees == trees::Season::none) return places;
  for (const osm::OsmPoint& tree : map.trees) add(tree.lon_lat);
  add_ways(map.tree_rows);
  return places;
}

std::optional<terrain::Extent> find_reach(const std::set<Tile>& tiles, double tile_m,
                                          const std::vector<glm::dvec2>& places, double max_m) {
  if (tiles.empty() || places.empty()) return {};
  terrain::Extent limit = empty_extent(), reach = empty_extent();
  for (const Tile& tile : tiles) {
    const glm::dvec2 corner = glm::dvec2(tile.column, tile.row) * tile_m;
    widen(limit, corner - max_m);
    widen(limit, corner + tile_m + max_m);
  }
  for (const glm::dvec2& p : places) widen(reach, glm::clamp(p, limit.low, limit.high));
  return reach;
}

void add_tiles(const std::vector<glm::dvec2>& places, const terrain::Extent& reach, double tile_m,
               std::set<Tile>& tiles) {
  for (const glm::dvec2& p : places)
    if (glm::clamp(p, reach.low, reach.high) == p)
      tiles.insert({static_cast<std::int32_t>(std::floor(p.x / tile_m)),
                    static_cast<std::int32_t>(std::floor(p.y / tile_m))});
}

}  // namespace nightcity::bake
