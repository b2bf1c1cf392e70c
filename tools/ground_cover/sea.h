// The sea of a map, which has its coasts alone: ways with the water on their right.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "tools/ground_cover/cover.h"
#include "tools/line.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"

namespace nightcity::ground_cover {

struct Sea {
  std::vector<Ring> rings;    // an odd number of them goes round each place of the sea
  double open_m = 0;          // of coasts that end within the box, as far as they lie in it
  double not_drawn_m = 0;     // of the other coasts, where those that are open leave it in doubt
  std::size_t continued = 0;  // ends of coasts that were led on to a side of the box
  std::size_t backward = 0;   // ways that have the land on their right, as the others say
};

/// Joins ways of a coast and closes them along the sides of a box. A coast parts the box whichever
/// way its ways run; on which side of it all the water lies, their lengths decide. An open coast is
/// left out where the others say that it lies on land; else there is no sea. One that ends within
/// `continued_m` of a side goes on to it.
Sea find_sea(const std::vector<Line>& ways, const Box& box, double continued_m = 0);

/// Adds the sea of the ways with natural=coastline to `cover`, below all other land. It ends at
/// `bounds` (E, N, m), or, where a coast ends before them, at those of the map, to which coasts
/// that end near them are led on.
void add_sea(std::span<const osm::OsmWay> ways, const std::optional<osm::LonLatBox>& map_bounds,
             const place::LonLatToFrame& to_frame, const Box& bounds, Cover& cover);

}  // namespace nightcity::ground_cover
