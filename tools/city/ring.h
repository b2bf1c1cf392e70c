// The area of a ring.
#pragma once

#include <glm/vec3.hpp>

#include "tools/city/city_model.h"

namespace nightcity::city {

/// Returns Newell's area vector (Sutherland, Sproull and Schumacker 1974): half the sum of cross
/// products of successive vertices, taken from the ring's first vertex so that coordinates of 10^7
/// m lose nothing. Its length is the ring's area when the ring is planar and simple.
glm::dvec3 area_vector(const Ring& ring);

}  // namespace nightcity::city
