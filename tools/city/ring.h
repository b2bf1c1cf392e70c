// The area of a ring, its vertices, and heights that are none.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

#include "tools/city/city_model.h"

namespace nightcity::city {

/// Returns Newell's area vector (Sutherland, Sproull and Schumacker 1974): half the sum of cross
/// products of successive vertices, taken from the ring's first vertex so that coordinates of 10^7
/// m lose nothing. Its length is the ring's area when the ring is planar and simple.
glm::dvec3 area_vector(const Ring& ring);

/// Returns the number of vertices of all rings of a polygon.
std::size_t count_vertices(const Polygon& polygon);

/// Gives a polygon the outline that lies outside of all others, where a file has it among the
/// holes. Returns whether it did.
bool set_outer_ring(Polygon& polygon);

/// Returns whether a height stands for "none": producers write -9999, -99999, -32768 or -3.4e38,
/// and blocks that stand on such a height end a little above. No ground is that low in metres or in
/// feet, and none is 30 km high.
inline bool is_sentinel_height(double z) {
  return z < -9900 || z > 30'000;
}
/// Returns whether any vertex has such a height.
bool has_sentinel_height(const Polygon& polygon);

}  // namespace nightcity::city
