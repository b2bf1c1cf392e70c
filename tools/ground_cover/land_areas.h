// The land of a map as areas: water, woods, grass, fields, yards, squares.
#pragma once

#include <optional>
#include <span>

#include "tools/ground_cover/cover.h"
#include "tools/osm/map_areas.h"
#include "tools/place/site.h"

namespace nightcity::ground_cover {

/// The use of an area of land, and its rank among areas (below those of streets, but for outlines
/// of streets themselves).
struct LandUse {
  int rank = 0;
  Surface surface;
};

/// Returns what an area with these tags covers the ground with; none where it says nothing about
/// the ground, or lies below it.
std::optional<LandUse> find_land_use(const osm::OsmTags& tags);

/// Selects the areas of a map that find_land_use knows.
osm::AreaSelection select_land();

/// Adds the areas to `cover`, as far as they lie in `bounds` (E, N, m). Of areas of one rank that
/// overlap the smaller one is seen.
void add_land(std::span<const osm::MapArea> areas, const place::LonLatToFrame& to_frame,
              const Box& bounds, Cover& cover);

}  // namespace nightcity::ground_cover
