// Finds how far the ground of a city that comes from its map alone has to reach, to hold the map's
// streets, tracks and trees.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <set>
#include <vector>

#include "tools/bake/city/cover_options.h"
#include "tools/bake/city/tile_grid.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"
#include "tools/terrain/surface_store.h"

namespace nightcity::bake {

/// Returns the places (E, N, m) of what `options` ask for of the map: the nodes of streets and of
/// tracks, and trees.
std::vector<glm::dvec2> find_map_places(const osm::OsmData& map, const CoverOptions& options,
                                        const place::LonLatToFrame& to_frame);

/// Returns the rectangle that holds the places as far as they lie within `max_m` of the tiles'
/// bounds. A place beyond stands for the nearest one within: a street that leads there is cut.
/// None without a tile or a place.
std::optional<terrain::Extent> find_reach(const std::set<Tile>& tiles, double tile_m,
                                          const std::vector<glm::dvec2>& places, double max_m);

/// Adds the tiles that hold places within `reach`.
void add_tiles(const std::vector<glm::dvec2>& places, const terrain::Extent& reach, double tile_m,
               std::set<Tile>& tiles);

}  // namespace nightcity::bake
