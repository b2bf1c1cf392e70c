// The surfaces of a flight of steps.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "tools/steps/flight.h"

namespace nightcity::steps {

/// A flight's sides reach this far into the ground, which falls and rises between its places, m.
constexpr double foot_m = 0.3;

/// E, N, H; counter-clockwise where a side looks outward.
using Corners = std::array<glm::dvec3, 3>;

/// Returns treads, risers, the walls on both sides and at the upper end, mitred at bends and open
/// below.
std::vector<Corners> make_shape(const Flight& flight);

}  // namespace nightcity::steps
