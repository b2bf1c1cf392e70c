// The plane in which a ring lies, and the ring in that plane's two coordinates.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "tools/city/ring.h"

namespace nightcity::mesh {

/// Right-handed frame (u, v, normal) at `origin`.
struct Plane {
  glm::dvec3 origin{0}, u{1, 0, 0}, v{0, 1, 0}, normal{0, 0, 1};

  glm::dvec2 flatten(const glm::dvec3& p) const;
  double distance(const glm::dvec3& p) const;
};

/// Returns the plane with the given unit normal through `origin`; u is horizontal where it can be.
Plane make_plane(const glm::dvec3& origin, const glm::dvec3& unit_normal);

/// Returns whether a vertex equals its predecessor (the last is that of the first).
bool has_duplicates(const city::Ring& ring);
/// Returns a copy without vertices equal to their predecessor (the closing one too).
city::Ring remove_duplicates(const city::Ring& ring);

}  // namespace nightcity::mesh
