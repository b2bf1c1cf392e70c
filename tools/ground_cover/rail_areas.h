// The railways of a map: beds as areas, and the rails on them or in the street.
#pragma once

#include <span>

#include "tools/ground_cover/cover.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"

namespace nightcity::ground_cover {

/// Ranks of the areas of beds: they lie over squares and land, and under streets. A bed that runs
/// along a pavement beside a carriageway, and does not cross it, lies over the pavement.
constexpr int bed_rank = 750, bed_along_pavement_rank = 810;

/// Adds the tracks to `cover`, as far as they lie in `bounds` (E, N, m): two rails, flush with
/// whatever lies there, and a bed of ballast, or of what `surface` says. Add streets and land
/// first: what runs in them has no bed. Those in tunnels, those on bridges that carry no street,
/// and those that are no longer or not yet there are left out; lengths of all are counted.
void add_rails(std::span<const osm::OsmWay> railways, const place::LonLatToFrame& to_frame,
               const Box& bounds, Cover& cover);

}  // namespace nightcity::ground_cover
