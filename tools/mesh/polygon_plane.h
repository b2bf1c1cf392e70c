// The plane a ring lies in, and the ring in that plane's two coordinates.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "tools/city/city_model.h"

namespace nightcity {

/// Newell's area vector (Sutherland, Sproull and Schumacker 1974): half the sum of cross products of
/// successive vertices, taken from the ring's first vertex so that coordinates of 10^7 m lose nothing. Its
/// length is the ring's area when the ring is planar and simple.
glm::dvec3 area_vector(const Ring& ring);

/// Right-handed frame (u, v, normal) at `origin`.
struct Plane {
  glm::dvec3 origin{0}, u{1, 0, 0}, v{0, 1, 0}, normal{0, 0, 1};

  glm::dvec2 flatten(const glm::dvec3& p) const;
  double distance(const glm::dvec3& p) const;
};

/// Plane with the given normal (unit) through `origin`; u is horizontal where it can be.
Plane plane_at(const glm::dvec3& origin, const glm::dvec3& unit_normal);

/// Copy without vertices equal to their predecessor (the closing one too).
Ring without_duplicates(const Ring& ring);

}  // namespace nightcity
