// The surfaces of barriers.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "tools/barriers/find_barriers.h"

namespace nightcity::barriers {

/// Barriers reach this far into the ground, which falls and rises between their points, m.
constexpr double foot_m = 0.3;
/// Posts of sheets: their distance and width (a usual panel fence), and how far behind the rails
/// they stand, m.
constexpr double post_spacing_m = 2.5, post_m = 0.06, post_behind_m = 0.03;

/// E, N, H; counter-clockwise where a side looks outward.
using Corners = std::array<glm::dvec3, 3>;

/// Returns a solid barrier as a box along its line, mitred at bends and open below; a sheet as
/// rails and posts, of which light passes the kind's gap whatever its direction: what a plane
/// stencil covers is the same share of every parallel projection.
std::vector<Corners> make_shape(const BarrierLine& line);
/// Returns an area's top and the sides along its outline.
std::vector<Corners> make_shape(const BarrierArea& area);

}  // namespace nightcity::barriers
