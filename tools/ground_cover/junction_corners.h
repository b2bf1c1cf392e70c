// Rounds the corners of carriageways where streets meet, and of the pavements beside them.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>

#include "tools/ground_cover/cover.h"
#include "tools/osm/osm_data.h"
#include "tools/place/site.h"

namespace nightcity::ground_cover {

/// Rank of a corner's carriageway: below those of streets, above their bays.
constexpr int corner_rank = 960;

/// A straight street that ends in a junction.
struct CornerArm {
  glm::dvec2 along;  // away from the junction, unit
  double length_m;
  double half_m;  // from its middle to the edge that is rounded
};

/// Returns the area between the edges of two arms and the arc of `radius_m` that touches both. It
/// begins a hand within the corner, so that outlines cross instead of running along each other. `second` is the next counter-clockwise from `first`. The arc is
/// smaller where an arm is short. None where less than half a metre is left, or the arms meet at
/// less than 45 degrees (an island lies between them) or more than 150 (there is no corner).
std::optional<Ring> make_corner(const glm::dvec2& junction, const CornerArm& first,
                                const CornerArm& second, double radius_m);

/// Adds the corners between the streets that meet in a place, three arms or more, but those of
/// entrances, tunnels and paths. A carriageway's radius is 6 m between main roads and 4 m elsewhere,
/// and pavements keep their width.
void add_corners(std::span<const osm::OsmWay> ways, const place::LonLatToFrame& to_frame,
                 const Box& bounds, Cover& cover);

}  // namespace nightcity::ground_cover
