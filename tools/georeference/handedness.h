// Finds out from a file's rings alone whether its x, y, z are right-handed.
#pragma once

#include <glm/vec3.hpp>
#include <span>

namespace nightcity::georeference {

/// Returns a score in [-1, 1]: above 0 right-handed (x east, y north), below 0 swapped; near 0
/// nothing can be said. The normals of CityGML's solids point outward and those of its terrain up,
/// so a file whose axes are swapped (x is north) shows them the wrong way round. `closed_rings`:
/// one after the other, the last vertex of each repeating its first.
double handedness(std::span<const glm::dvec3> closed_rings);

}  // namespace nightcity::georeference
